// Points marked in two calibrated views, as motion. [Basu98, section 3: a camera and a mirror]
// A view is CSV as a motion is (viapoints/motion_csv.hpp), with columns NAME_u_px and NAME_v_px, origin at
// the picture's top left corner. The cameras are JSON:
//   {"first": [[12 numbers]], "second": ...}: rows of the 3 x 4 matrix that takes homogeneous head
//   coordinates in mm to homogeneous pixels of the first and of the second view.
#pragma once

#include <string>
#include <string_view>

#include "lipmodel/two_views.hpp"
#include "viapoints/motion.hpp"

namespace viaface {

struct CameraPair {
    Projection first, second;
};

// InputError("cameras", ...) for anything else.
CameraPair parse_cameras(std::string_view json);

struct TwoViewMotion {
    Motion motion;        // a point is missing where either view misses it
    double error_px = 0;  // rms over all points: how far their images are from what was marked
};

// InputError("views", ...) when the views differ in their times or have no point in common.
TwoViewMotion triangulated(const Motion& first, const Motion& second, const CameraPair& cameras);

}  // namespace viaface
