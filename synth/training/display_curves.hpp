// Curves on a scan's surface that the display mesh keeps: contours of the lips, edges of the lids, roots of
// lashes, rims of ears. Each is a list of anchors at equal steps of arc in space.
#pragma once

#include <vector>

#include "facemodel/lips.hpp"
#include "facemodel/remesh.hpp"

namespace viaface {

using Curve = std::vector<Anchor>;

inline constexpr int kLidNodes = 40;

std::vector<Vector2d> places_of(const Curve& curve, const Chart& chart);
std::vector<Vector3d> spatial(const Curve& curve, const Nodes& scan);

// Along a closed chain of scan nodes, half a step off its start.
Curve resample_loop(const Loop& loop, const Nodes& scan, int count);

// ring: scan nodes round the lips; left, bottom, right: which of them are cardinal; the first is the top.
Curve lip_contour(const std::vector<int>& ring, int left, int bottom, int right, const Chart& chart,
                  const Nodes& scan);

// Midway on the surface between two contours, column by column.
Curve midway(const Curve& outer, const Curve& inner, const Chart& chart, const Nodes& scan);

// The loop moved outwards by `out` mm.
Curve offset_loop(const Curve& loop, double out, const Chart& chart, const Nodes& scan);

// The lid's edge, where it folds towards the eyeball: upper lid from the inner to the outer corner, then the
// lower lid back.
struct LidEdge {
    std::vector<Vector2d> upper, lower;  // fine curves of the chart
    Curve ring;                          // kLidNodes at equal steps of each lid
};
LidEdge lid_edge(const std::vector<int>& upper, const std::vector<int>& lower, const Chart& chart,
                 const Nodes& scan);

// Where lashes grow on one lid: nose to temple, off the corners.
Curve lash_roots(const std::vector<Vector2d>& lid, bool from_temple, const Chart& chart, const Nodes& scan);

// Where an ear stands out farthest at each height, so that its outline from the front is one of the mesh's
// own curves. side: +1 the talker's left.
Curve ear_rim(double side, const Chart& chart, const Nodes& scan);

}  // namespace viaface
