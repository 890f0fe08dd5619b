// A mesh of our own topology on the surface of a scan: anchors on its triangles, a flat chart of it, samples
// at a wanted spacing and a triangulation that keeps feature contours. Because a node is an anchor, every
// posed scan of the same topology gives the mesh in that posture. [ATR98, "Face and lip mesh adaptation"]
// Departure: the report adapts one generic mesh to each scan by field morphing; scans that share a topology
// need no morphing, only anchors. The chart is Floater's [Floater03]: each inner node is the mean-value
// weighted mean of its neighbours, the outer loop lies on the unit circle, holes are closed by a hub. All
// weights are positive, so no triangle flips.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "facemodel/mesh.hpp"

namespace viaface {

using Eigen::Vector2d;
using Eigen::Vector3d;

// A place on a scan's surface: a mean of three of its nodes.
struct Anchor {
    Triangle nodes{};
    Vector3d weights = Vector3d::Zero();  // sum 1

    Vector3d at(const Nodes& scan) const;
};

Nodes nodes_at(const std::vector<Anchor>& anchors, const Nodes& scan);

using Loop = std::vector<int>;

// The directed boundary loops of a triangle mesh (surface on their left).
std::vector<Loop> boundary_loops(const std::vector<Triangle>& triangles);

class Chart {
  public:
    // scan: [nodes x 3], mm; triangles: a connected piece of it. The loop with the most nodes becomes the
    // circle.
    Chart(const Nodes& scan, std::vector<Triangle> triangles);

    const std::vector<Triangle>& triangles() const { return triangles_; }
    const Loop& outer() const { return outer_; }
    const std::vector<Loop>& holes() const { return holes_; }
    Vector2d uv(int node) const { return uv_[static_cast<std::size_t>(node)]; }
    Vector2d uv(const Anchor& anchor) const;
    // The anchor at a place of the chart; of the nearest triangle when the place is in a hole or outside.
    Anchor locate(const Vector2d& place) const;

  private:
    void flatten(const Nodes& scan);
    void build_grid();

    std::vector<Triangle> triangles_;
    Loop outer_;
    std::vector<Loop> holes_;
    std::vector<Vector2d> uv_;            // by scan node; only those of the piece are set
    std::vector<std::vector<int>> grid_;  // triangles by cell
};

bool inside(const std::vector<Vector2d>& polygon, const Vector2d& place);  // even-odd rule

// Repeatable numbers (SplitMix64).
class Dice {
  public:
    explicit Dice(std::uint64_t seed) : state_(seed) {}
    std::uint64_t bits();
    double unit();  // [0, 1)

  private:
    std::uint64_t state_;
};

using Spacing = std::function<double(const Vector3d&)>;  // place in mm -> wanted edge length in mm
using Keep = std::function<bool(const Anchor&)>;

// Samples on the triangles of a chart at about the wanted spacing of each other and of the fixed anchors:
// darts, then relaxed towards the centres of their cells.
std::vector<Anchor> sample_surface(const Nodes& scan, const Chart& chart, const std::vector<Anchor>& fixed,
                                   const Spacing& spacing, const Keep& keep, std::uint64_t seed);

// Triangles over places of a chart. Each loop lists places in order; the first bounds the domain from
// outside, the rest are holes; all their edges are kept. Inner edges are then flipped until no pair of angles
// opposite an edge exceeds a straight angle in space.
std::vector<Triangle> triangulate(const std::vector<Vector2d>& places, const Nodes& nodes,
                                  const std::vector<Loop>& loops);

}  // namespace viaface
