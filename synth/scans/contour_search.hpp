// Feature contours found in a rendered front view of an aligned scan.
//  - Eyes and lips: the generic head's contour, shifted and stretched (upper and lower half each by itself),
//    so that what is within differs most from what is round about it, in the mean redness and brightness of
//    the skin beside their spread: region-based active contours [ChanVese01] held to a shape of few numbers.
//  - The line where closed lips meet: the path of least cost from corner to corner through what is dark and
//    concave, by dynamic programming.
// A scan without colours gives neither; its features are then found by shape alone.
#pragma once

#include <array>

#include "synth/scans/painted_surface.hpp"

namespace viaface {

using PlaneLoop = std::vector<Eigen::Vector2d>;  // x, y, mm, of the front view

// Shift x, y in mm; stretch in x, of the upper half, of the lower half.
using ContourNumbers = std::array<double, 5>;

struct ShapedContour {
    ContourNumbers numbers{0, 0, 1, 1, 1};
    PlaneLoop loop;
    double contrast = 0;  // squared difference of means by variance; 0 when it was not searched
    double moved = 0;     // mm, mean over the loop
};

enum class Within { kEye, kLips };

// freedom: of shifts and stretches; 1 for a generic contour, less for one that is nearly there.
ShapedContour shaped_contour(const SurfaceView& view, const PlaneLoop& generic, Within what, double freedom);

PlaneLoop shaped_by(const PlaneLoop& generic, const ContourNumbers& numbers);

// The line where closed lips meet, left of the picture first, a place per mm, from corner to corner. The
// generic corners say where to look; the line ends where it is no longer dark or concave.
PlaneLoop lip_line(const SurfaceView& view, const Eigen::Vector2d& left, const Eigen::Vector2d& right);

// `loop` shifted and stretched in x so that its outermost places come to be at `left` and `right`.
PlaneLoop between_corners(const PlaneLoop& loop, const Eigen::Vector2d& left, const Eigen::Vector2d& right);

}  // namespace viaface
