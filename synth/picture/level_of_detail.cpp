#include "synth/picture/level_of_detail.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "synth/picture/surface_frame.hpp"

namespace viaface {
namespace {

using Eigen::RowVector2f;
using Eigen::RowVector3f;
using Eigen::Vector3f;
using Rows = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

constexpr double kWay = 0.2;    // pixels: samples lie a quarter of one apart
constexpr double kBend = 0.08;  // 1/mm
constexpr double kMostBend = 0.2;
constexpr float kTurn = 5;         // bend of a triangle as against its corners
constexpr double kReach = 3;       // standard deviations of a mode
constexpr int kPasses = 8;         // over all nodes
constexpr float kBeyond = -0.01f;  // share of a corner, from rounding

// The neighbours of a node in their order round it.
class Ring {
  public:
    static constexpr int kMost = 16;

    int size() const { return size_; }
    int operator[](int i) const { return nodes_[i < size_ ? i : i - size_]; }
    void add(int node) { nodes_[size_++] = node; }
    bool holds(int node) const { return std::find(nodes_.begin(), end(), node) != end(); }

  private:
    std::array<int, kMost>::const_iterator end() const { return nodes_.begin() + size_; }
    std::array<int, kMost> nodes_{};
    int size_ = 0;
};

// [nodes x 3 (1 + modes + shapes)], mm: each node's place at rest, then its ways from there.
Rows reaches_of(const Face& face, const FacePart& part) {
    const Eigen::Index modes = face.modes.cols(), shapes = std::ssize(face.shapes);
    Rows reaches(part.nodes, 3 * (1 + modes + shapes));
    reaches.leftCols<3>() = face.rest.middleRows(part.first_node, part.nodes).cast<float>();
    for (Eigen::Index k = 0; k < modes; ++k) {
        const double reach = kReach * std::sqrt(face.mode_variance[k]);
        const auto ways = face.modes.col(k).segment(3 * part.first_node, 3 * part.nodes);
        reaches.middleCols<3>(3 + 3 * k) =
            (reach * ways.reshaped<Eigen::RowMajor>(part.nodes, 3)).cast<float>();
    }
    for (Eigen::Index k = 0; k < shapes; ++k)
        reaches.middleCols<3>(3 + 3 * (modes + k)) =
            face.shapes[k].delta.middleRows(part.first_node, part.nodes).cast<float>();
    return reaches;
}

std::vector<std::uint8_t> welded_nodes(const Face& face) {
    std::vector<int> there(face.weld.size());
    for (const int first : face.weld) ++there[first];
    std::vector<std::uint8_t> welded;
    for (const int first : face.weld) welded.push_back(there[first] > 1);
    return welded;
}

float doubled_area(const RowVector2f& a, const RowVector2f& b, const RowVector2f& c) {
    return (b.x() - a.x()) * (c.y() - a.y()) - (c.x() - a.x()) * (b.y() - a.y());
}

class Thinning {
  public:
    // `stays`: of each node of the face, 1 where it may not be taken out. normals: [nodes of the face x 3]
    Thinning(const Face& face, const FacePart& part, const std::vector<std::uint8_t>& stays,
             const NodesF& normals, const Coarseness& most)
        : first_node_(part.first_node),
          most_way_(float(most.way)),
          most_bend_(float(most.bend)),
          normals_(normals.middleRows(part.first_node, part.nodes)),
          modes_(face.modes.cols()),
          reaches_(reaches_of(face, part)),
          uvs_(face.uvs.middleRows(part.first_node, part.nodes)),
          around_(part.nodes),
          stays_(stays.begin() + part.first_node, stays.begin() + part.first_node + part.nodes) {
        for (const auto& [a, b, c] : part.triangles)
            triangles_.push_back({a - first_node_, b - first_node_, c - first_node_});
        for (int i = 0; i < int(triangles_.size()); ++i) {
            for (const int node : triangles_[i]) around_[node].push_back(i);
        }
        taken_out_.resize(triangles_.size());
    }

    void run() {
        std::vector<std::uint8_t> tried(around_.size());
        for (int pass = 0, taken = 1; pass < kPasses && taken > 0; ++pass) {
            std::vector<std::uint8_t> waits(around_.size());
            taken = 0;
            for (int node = 0; node < int(around_.size()); ++node) {
                if (stays_[node] || waits[node] || tried[node]) continue;
                tried[node] = 1;
                const std::optional<Ring> ring = ring_of(node);
                if (!ring || !take_out(node, *ring)) continue;
                ++taken;
                for (int i = 0; i < ring->size(); ++i) waits[(*ring)[i]] = 1, tried[(*ring)[i]] = 0;
            }
        }
    }

    std::vector<Triangle> triangles() const {
        std::vector<Triangle> left;
        for (const auto& [a, b, c] : triangles_) {
            if (a >= 0) left.push_back({a + first_node_, b + first_node_, c + first_node_});
        }
        return left;
    }

  private:
    struct Placed {
        int node, triangle;  // of those that are new
    };

    // A fan of triangles over a ring, from one of its nodes.
    struct Fan {
        const Ring& ring;
        int from;

        int size() const { return ring.size() - 2; }
        Triangle operator[](int i) const { return {ring[from], ring[from + i + 1], ring[from + i + 2]}; }
    };

    // None at the part's edges.
    std::optional<Ring> ring_of(int node) const {
        const std::vector<int>& around = around_[node];
        if (around.size() < 3 || around.size() > Ring::kMost) return {};
        Ring ring;
        int next = triangles_[around.front()][0];
        if (next == node) next = triangles_[around.front()][1];
        for (std::size_t i = 0; i < around.size(); ++i) {
            ring.add(next);
            next = after(node, next);
            if (next < 0) return {};
        }
        return next == ring[0] ? std::optional(ring) : std::nullopt;
    }

    // The third corner of the triangle on the left of the way from `node` to `other`; -1 without one.
    int after(int node, int other) const {
        for (const int i : around_[node]) {
            const Triangle& t = triangles_[i];
            for (int k = 0; k < 3; ++k) {
                if (t[k] == node && t[(k + 1) % 3] == other) return t[(k + 2) % 3];
            }
        }
        return -1;
    }

    bool take_out(int node, const Ring& ring) {
        for (int from = 0; from < ring.size(); ++from) {
            const Fan fan{ring, from};
            if (!seat(node, fan) || !fits(node, fan) || !joins(node, fan)) continue;
            std::vector<Placed> placed;
            if (!place_all(node, fan, placed)) continue;
            replace(node, fan, placed);
            return true;
        }
        return false;
    }

    float area(const Triangle& t) const {
        return doubled_area(uvs_.row(t[0]), uvs_.row(t[1]), uvs_.row(t[2]));
    }
    RowVector3f place(int node) const { return reaches_.row(node).head<3>(); }
    RowVector3f normal(const Triangle& t) const {
        return (place(t[1]) - place(t[0])).cross(place(t[2]) - place(t[0]));
    }

    // No new triangle is turned over, in the texture or at rest.
    bool fits(int node, const Fan& fan) const {
        bool left = false, right = false;
        for (const int i : around_[node]) (area(triangles_[i]) > 0 ? left : right) = true;
        for (int i = 0; i < fan.size(); ++i) {
            const RowVector3f n = normal(fan[i]);
            if (left == right || (area(fan[i]) > 0) != left) return false;
            for (const int corner : fan[i]) {
                if (!(bend(n, corner) <= kTurn * most_bend_)) return false;
            }
        }
        return true;
    }

    // The surface does not come to touch itself: new edges are none that there are.
    bool joins(int node, const Fan& fan) const {
        const Ring& ring = fan.ring;
        const int to = ring[fan.from], before = ring[fan.from + ring.size() - 1], after = ring[fan.from + 1];
        for (const int i : around_[to]) {
            for (const int corner : triangles_[i]) {
                const bool known = corner == to || corner == node || corner == before || corner == after;
                if (!known && ring.holds(corner)) return false;
            }
        }
        return true;
    }

    bool place_all(int node, const Fan& fan, std::vector<Placed>& placed) const {
        placed.push_back({node, *seat(node, fan)});
        for (const int i : around_[node]) {
            for (const int one : taken_out_[i]) {
                const std::optional<int> to = seat(one, fan);
                if (!to) return false;
                placed.push_back({one, *to});
            }
        }
        return true;
    }

    // The triangle that a node's texture coordinates lie in, if it lies near enough to the place they have
    // there.
    std::optional<int> seat(int node, const Fan& fan) const {
        const RowVector2f at = uvs_.row(node);
        for (int i = 0; i < fan.size(); ++i) {
            const Triangle t = fan[i];
            const RowVector2f a = uvs_.row(t[0]), b = uvs_.row(t[1]), c = uvs_.row(t[2]);
            const Vector3f areas(doubled_area(at, b, c), doubled_area(a, at, c), doubled_area(a, b, at));
            const Vector3f shares = areas / doubled_area(a, b, c);
            if (shares.minCoeff() < kBeyond) continue;
            if (near_enough(node, t, shares)) return i;
        }
        return {};
    }

    float bend(const RowVector3f& normal, int node) const {
        return (normal.normalized() - normals_.row(node)).norm();
    }

    bool near_enough(int node, const Triangle& t, const Vector3f& shares) const {
        const auto off = [&](Eigen::Index from, Eigen::Index columns) {
            return (reaches_.row(node).segment(from, columns) -
                    shares[0] * reaches_.row(t[0]).segment(from, columns) -
                    shares[1] * reaches_.row(t[1]).segment(from, columns) -
                    shares[2] * reaches_.row(t[2]).segment(from, columns))
                .norm();
        };
        const RowVector3f shaded =
            shares[0] * normals_.row(t[0]) + shares[1] * normals_.row(t[1]) + shares[2] * normals_.row(t[2]);
        if (!(bend(shaded, node) <= most_bend_)) return false;
        if (!(off(0, 3) <= most_way_) || !(off(3, 3 * modes_) <= most_way_)) return false;
        for (Eigen::Index shape = 3 * (1 + modes_); shape < reaches_.cols(); shape += 3) {
            if (!(off(shape, 3) <= most_way_)) return false;
        }
        return true;
    }

    void replace(int node, const Fan& fan, const std::vector<Placed>& placed) {
        const std::vector<int> old = std::move(around_[node]);
        around_[node].clear();
        for (const int i : old) {
            for (const int corner : triangles_[i]) std::erase(around_[corner], i);
            triangles_[i] = {-1, -1, -1};
            taken_out_[i].clear();
        }
        for (int i = 0; i < fan.size(); ++i) {
            triangles_[old[i]] = fan[i];
            for (const int corner : fan[i]) around_[corner].push_back(old[i]);
        }
        for (const auto& [one, triangle] : placed) taken_out_[old[triangle]].push_back(one);
    }

    const int first_node_;
    const float most_way_, most_bend_;
    const NodesF normals_;
    const Eigen::Index modes_;
    const Rows reaches_;
    const Eigen::Matrix<float, Eigen::Dynamic, 2, Eigen::RowMajor> uvs_;
    std::vector<Triangle> triangles_;          // of the part's own nodes; -1 where there is none any more
    std::vector<std::vector<int>> around_;     // triangles, of each node
    std::vector<std::vector<int>> taken_out_;  // nodes that lie in each triangle
    std::vector<std::uint8_t> stays_;          // of each node
};

}  // namespace

Coarseness coarseness_for(double pixel) { return {kWay * pixel, std::min(kBend * pixel, kMostBend)}; }

std::vector<FacePart> coarser_parts(const Face& face, const Coarseness& most, WorkPool& pool) {
    const std::vector<std::uint8_t> stays = welded_nodes(face);
    NodesF normals;
    NodeNormals(face).compute(face.rest.cast<float>(), normals);
    std::vector<FacePart> parts = face.parts;
    pool.share(int(parts.size()), [&](int i, int) {
        if (parts[i].drive == Drive::kTongue) return;
        Thinning thinning(face, parts[i], stays, normals, most);
        thinning.run();
        parts[i].triangles = thinning.triangles();
    });
    return parts;
}

}  // namespace viaface
