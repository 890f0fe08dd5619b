#include "facemodel/triangulation.hpp"

#include <deque>
#include <numeric>
#include <stdexcept>

namespace viaface {
namespace {

using Eigen::Vector2d;

// By 0.1: no two of a grid have equal x.
std::vector<Vector2d> rotated(const std::vector<Vector2d>& places) {
    constexpr double kCosine = 0.9950041652780258, kSine = 0.09983341664682815;
    std::vector<Vector2d> turned;
    for (const Vector2d& p : places) {
        turned.emplace_back(kCosine * p.x() - kSine * p.y(), kSine * p.x() + kCosine * p.y());
    }
    return turned;
}

// Left and right halves of a face put four points on a circle everywhere; the shift breaks every such tie.
Flat shifted(const Flat& points) {
    constexpr double kShift = 1e-6;
    Flat moved = points;
    for (Eigen::Index i = 0; i < points.rows(); ++i) {
        const double phase = 12.9898 * points(i, 0) + 78.233 * points(i, 1);
        moved.row(i) += kShift * Eigen::RowVector2d(std::sin(phase), std::cos(1.7 * phase));
    }
    return moved;
}

}  // namespace

double turn(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
    return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

Triangulation::Triangulation(const std::vector<Vector2d>& places) : places_(rotated(places)) {
    if (places.size() < 3) throw std::invalid_argument("three or more places make a triangulation");
    sweep();
    flip_while({}, [&](int a, int b, int c, int d) { return obtuse_opposite(at(a), at(b), at(c), at(d)); });
}

// Each edge in the way is flipped as soon as its two triangles make a convex quad. [Sloan93]
void Triangulation::insert(int a, int b) {
    std::deque<Edge> crossing;
    for (const auto& [edge, sides] : sides_) {
        if (crosses(edge, a, b)) crossing.push_back(edge);
    }
    const std::size_t most = crossing.size() * crossing.size() + 1;
    for (std::size_t tries = 0; !crossing.empty() && tries < most; ++tries) {
        const Edge edge = crossing.front();
        crossing.pop_front();
        const auto [c, d] = opposite(edge);
        if (d >= 0 && convex(edge, c, d)) {
            flip(edge);
            if (crosses(edge_of(c, d), a, b)) crossing.push_back(edge_of(c, d));
        } else {
            crossing.push_back(edge);
        }
    }
    if (!sides_.contains(edge_of(a, b))) throw std::runtime_error("a contour crosses itself in the chart");
}

void Triangulation::restrict_to(std::vector<Triangle> kept) {
    triangles_ = std::move(kept);
    sides_.clear();
    for (std::size_t i = 0; i < triangles_.size(); ++i) note(static_cast<int>(i));
}

void Triangulation::flip_while(const std::set<Edge>& kept, const Better& better) {
    constexpr int kMostRounds = 60;
    for (int round = 0; round < kMostRounds; ++round) {
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
    throw std::runtime_error("the flips of a triangulation come to no end");
}

int Triangulation::apex(int triangle, const Edge& edge) const {
    for (const int node : triangles_[static_cast<std::size_t>(triangle)]) {
        if (node != edge.first && node != edge.second) return node;
    }
    return -1;
}

std::pair<int, int> Triangulation::opposite(const Edge& edge) const {
    const auto& sides = sides_.at(edge);
    return {apex(sides[0], edge), sides[1] < 0 ? -1 : apex(sides[1], edge)};
}

bool Triangulation::convex(const Edge& edge, int c, int d) const {
    const double one = turn(at(c), at(d), at(edge.first)), two = turn(at(c), at(d), at(edge.second));
    const double three = turn(at(edge.first), at(edge.second), at(c)),
                 four = turn(at(edge.first), at(edge.second), at(d));
    return one * two < 0 && three * four < 0;
}

bool Triangulation::crosses(const Edge& edge, int a, int b) const {
    if (edge.first == a || edge.second == a || edge.first == b || edge.second == b) return false;
    return turn(at(a), at(b), at(edge.first)) * turn(at(a), at(b), at(edge.second)) < 0 &&
           turn(at(edge.first), at(edge.second), at(a)) * turn(at(edge.first), at(edge.second), at(b)) < 0;
}

void Triangulation::note(int index) {
    const Triangle& t = triangles_[static_cast<std::size_t>(index)];
    for (std::size_t k = 0; k < 3; ++k) {
        auto& sides = sides_.try_emplace(edge_of(t[k], t[(k + 1) % 3]), std::array{-1, -1}).first->second;
        (sides[0] < 0 ? sides[0] : sides[1]) = index;
    }
}

void Triangulation::forget(int index) {
    const Triangle& t = triangles_[static_cast<std::size_t>(index)];
    for (std::size_t k = 0; k < 3; ++k) {
        const auto found = sides_.find(edge_of(t[k], t[(k + 1) % 3]));
        auto& sides = found->second;
        if (sides[0] == index) std::swap(sides[0], sides[1]);
        sides[1] = -1;
        if (sides[0] < 0) sides_.erase(found);
    }
}

void Triangulation::set(int index, int a, int b, int c) {
    triangles_[static_cast<std::size_t>(index)] =
        turn(at(a), at(b), at(c)) > 0 ? Triangle{a, b, c} : Triangle{a, c, b};
    note(index);
}

void Triangulation::flip(Edge edge) {
    const auto sides = sides_.at(edge);
    const auto [c, d] = opposite(edge);
    forget(sides[0]);
    forget(sides[1]);
    set(sides[0], c, d, edge.first);
    set(sides[1], c, d, edge.second);
}

void Triangulation::add(int a, int b, int c) {
    triangles_.push_back({});
    set(static_cast<int>(triangles_.size()) - 1, a, b, c);
}

std::vector<int> Triangulation::swept_order() const {
    const auto place = [&](int i) { return std::pair(at(i).x(), at(i).y()); };
    std::vector<int> order(places_.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::sort(order, {}, place);
    if (std::ranges::adjacent_find(order, {}, place) != order.end()) {
        throw std::invalid_argument("two places of a triangulation are one");
    }
    return order;
}

// Adds the places from left to right, each joined to the part of the hull it sees. The hull runs
// counter-clockwise.
void Triangulation::sweep() {
    const std::vector<int> order = swept_order();
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

std::vector<Triangle> delaunay(const Flat& points) {
    const Flat moved = shifted(points);
    std::vector<Vector2d> places;
    for (Eigen::Index i = 0; i < moved.rows(); ++i) places.emplace_back(moved.row(i));
    return Triangulation(places).triangles();
}

}  // namespace viaface
