#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <stdexcept>

#include "facemodel/remesh.hpp"

namespace viaface {
namespace {

using Edge = std::pair<int, int>;
Edge edge_of(int a, int b) { return std::minmax(a, b); }

double turn(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
    return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

// Triangles with the two at each edge at hand.
class Triangulation {
  public:
    Triangulation(const std::vector<Vector2d>& places) : places_(places) { sweep(); }

    const std::vector<Triangle>& triangles() const { return triangles_; }

    void restrict_to(std::vector<Triangle> kept) {
        triangles_ = std::move(kept);
        sides_.clear();
        for (std::size_t i = 0; i < triangles_.size(); ++i) note(static_cast<int>(i));
    }

    // Flips inner edges that are not kept while `better` says so; at most `rounds` times over all edges.
    template <class Better>
    void flip_while(const std::set<Edge>& kept, int rounds, Better better) {
        for (int round = 0; round < rounds; ++round) {
            std::vector<Edge> edges;
            for (const auto& [edge, sides] : sides_) edges.push_back(edge);
            bool flipped = false;
            for (const Edge& edge : edges) {
                if (kept.contains(edge) || !sides_.contains(edge)) continue;
                const auto [c, d] = opposite(edge);
                if (d < 0 || !convex(edge, c, d) || !better(edge.first, edge.second, c, d)) continue;
                flip(edge);
                flipped = true;
            }
            if (!flipped) return;
        }
    }

    void insert(int a, int b) {
        for (int guard = 0; guard < 10000 && !sides_.contains(edge_of(a, b)); ++guard) {
            std::vector<Edge> crossing;
            for (const auto& [edge, sides] : sides_) {
                if (crosses(edge, a, b)) crossing.push_back(edge);
            }
            bool flipped = false;
            for (std::size_t k = 0; k < crossing.size() && !flipped; ++k) {
                const Edge edge = crossing[(k + static_cast<std::size_t>(guard)) % crossing.size()];
                const auto [c, d] = opposite(edge);
                if (d < 0 || !convex(edge, c, d)) continue;
                flip(edge);
                flipped = true;
            }
            if (!flipped) break;
        }
        if (!sides_.contains(edge_of(a, b)))
            throw std::runtime_error("a contour crosses itself in the chart");
    }

  private:
    const Vector2d& at(int i) const { return places_[static_cast<std::size_t>(i)]; }

    void note(int index) {
        const Triangle& t = triangles_[static_cast<std::size_t>(index)];
        for (std::size_t k = 0; k < 3; ++k) {
            auto& sides = sides_.try_emplace(edge_of(t[k], t[(k + 1) % 3]), std::array{-1, -1}).first->second;
            (sides[0] < 0 ? sides[0] : sides[1]) = index;
        }
    }

    void forget(int index) {
        const Triangle& t = triangles_[static_cast<std::size_t>(index)];
        for (std::size_t k = 0; k < 3; ++k) {
            const auto found = sides_.find(edge_of(t[k], t[(k + 1) % 3]));
            auto& sides = found->second;
            if (sides[0] == index) std::swap(sides[0], sides[1]);
            sides[1] = -1;
            if (sides[0] < 0) sides_.erase(found);
        }
    }

    int apex(int triangle, const Edge& edge) const {
        for (const int node : triangles_[static_cast<std::size_t>(triangle)]) {
            if (node != edge.first && node != edge.second) return node;
        }
        return -1;
    }

    std::pair<int, int> opposite(const Edge& edge) const {
        const auto& sides = sides_.at(edge);
        return {apex(sides[0], edge), sides[1] < 0 ? -1 : apex(sides[1], edge)};
    }

    bool convex(const Edge& edge, int c, int d) const {
        const double one = turn(at(c), at(d), at(edge.first)), two = turn(at(c), at(d), at(edge.second));
        const double three = turn(at(edge.first), at(edge.second), at(c)),
                     four = turn(at(edge.first), at(edge.second), at(d));
        return one * two < 0 && three * four < 0;
    }

    bool crosses(const Edge& edge, int a, int b) const {
        if (edge.first == a || edge.second == a || edge.first == b || edge.second == b) return false;
        return turn(at(a), at(b), at(edge.first)) * turn(at(a), at(b), at(edge.second)) < 0 &&
               turn(at(edge.first), at(edge.second), at(a)) * turn(at(edge.first), at(edge.second), at(b)) <
                   0;
    }

    void set(int index, int a, int b, int c) {
        triangles_[static_cast<std::size_t>(index)] =
            turn(at(a), at(b), at(c)) > 0 ? Triangle{a, b, c} : Triangle{a, c, b};
        note(index);
    }

    void flip(const Edge edge) {
        const auto sides = sides_.at(edge);
        const auto [c, d] = opposite(edge);
        forget(sides[0]);
        forget(sides[1]);
        set(sides[0], c, d, edge.first);
        set(sides[1], c, d, edge.second);
    }

    void add(int a, int b, int c) {
        triangles_.push_back({});
        set(static_cast<int>(triangles_.size()) - 1, a, b, c);
    }

    // Adds the places from left to right, each joined to the part of the hull it sees. The hull runs
    // counter-clockwise.
    void sweep() {
        std::vector<int> order(places_.size());
        std::iota(order.begin(), order.end(), 0);
        std::sort(order.begin(), order.end(), [&](int a, int b) {
            return std::pair(at(a).x(), at(a).y()) < std::pair(at(b).x(), at(b).y());
        });
        std::vector<int> next(places_.size()), previous(places_.size());
        const auto link = [&](int a, int b) {
            next[static_cast<std::size_t>(a)] = b;
            previous[static_cast<std::size_t>(b)] = a;
        };
        int a = order[0], b = order[1];
        const int c = order[2];
        if (turn(at(a), at(b), at(c)) < 0) std::swap(a, b);
        add(a, b, c);
        link(a, b);
        link(b, c);
        link(c, a);
        for (std::size_t k = 3; k < order.size(); ++k) {
            const int node = order[k];
            int forward = order[k - 1], back = forward;
            for (int to = next[static_cast<std::size_t>(forward)]; turn(at(forward), at(to), at(node)) < 0;
                 to = next[static_cast<std::size_t>(forward)]) {
                add(forward, to, node);
                forward = to;
            }
            for (int from = previous[static_cast<std::size_t>(back)]; turn(at(from), at(back), at(node)) < 0;
                 from = previous[static_cast<std::size_t>(back)]) {
                add(from, back, node);
                back = from;
            }
            link(back, node);
            link(node, forward);
        }
    }

    const std::vector<Vector2d>& places_;
    std::vector<Triangle> triangles_;
    std::map<Edge, std::array<int, 2>> sides_;
};

template <class Place>
double angle_at(const Place& at, const Place& a, const Place& b) {
    const Place u = (a - at).normalized(), v = (b - at).normalized();
    return std::acos(std::clamp(u.dot(v), -1.0, 1.0));
}

// The sum of the angles opposite edge (a, b) seen from c and d.
template <class Place>
double opposite_angles(const Place& a, const Place& b, const Place& c, const Place& d) {
    return angle_at(c, a, b) + angle_at(d, a, b);
}

std::vector<Vector2d> corners_of(const Loop& loop, const std::vector<Vector2d>& places) {
    std::vector<Vector2d> corners;
    for (const int i : loop) corners.push_back(places[static_cast<std::size_t>(i)]);
    return corners;
}

std::vector<Vector2d> rotated(const std::vector<Vector2d>& places) {
    constexpr double kCosine = 0.9950041652780258, kSine = 0.09983341664682815;  // of 0.1: no two equal x
    std::vector<Vector2d> turned;
    for (const Vector2d& p : places) {
        turned.emplace_back(kCosine * p.x() - kSine * p.y(), kSine * p.x() + kCosine * p.y());
    }
    return turned;
}

}  // namespace

std::vector<Triangle> triangulate(const std::vector<Vector2d>& given, const Nodes& nodes,
                                  const std::vector<Loop>& loops) {
    constexpr int kMostRounds = 60;
    constexpr double kStraight = 3.14159265358979 + 1e-6;
    if (given.size() < 3) throw std::invalid_argument("three or more places make a triangulation");
    const std::vector<Vector2d> places = rotated(given);
    Triangulation mesh(places);
    const auto place = [&](int i) -> const Vector2d& { return places[static_cast<std::size_t>(i)]; };
    mesh.flip_while({}, kMostRounds, [&](int a, int b, int c, int d) {
        return opposite_angles(place(a), place(b), place(c), place(d)) > kStraight;
    });
    std::set<Edge> kept;
    for (const Loop& loop : loops) {
        for (std::size_t k = 0; k < loop.size(); ++k) {
            const int a = loop[k], b = loop[(k + 1) % loop.size()];
            mesh.insert(a, b);
            kept.insert(edge_of(a, b));
        }
    }
    std::vector<std::vector<Vector2d>> outlines;
    for (const Loop& loop : loops) outlines.push_back(corners_of(loop, places));
    std::vector<Triangle> domain;
    for (const Triangle& t : mesh.triangles()) {
        const Vector2d centre = (place(t[0]) + place(t[1]) + place(t[2])) / 3;
        bool in = outlines.empty() || inside(outlines[0], centre);
        for (std::size_t k = 1; k < outlines.size(); ++k) in = in && !inside(outlines[k], centre);
        if (in) domain.push_back(t);
    }
    mesh.restrict_to(std::move(domain));
    const auto node = [&](int i) -> Vector3d { return nodes.row(i).transpose(); };
    mesh.flip_while(kept, kMostRounds, [&](int a, int b, int c, int d) {
        return opposite_angles(node(a), node(b), node(c), node(d)) > kStraight;
    });
    return mesh.triangles();
}

}  // namespace viaface
