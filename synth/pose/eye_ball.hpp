// The eye's shape: a sphere with a cornea's bulge about the way it looks.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace viaface {

struct EyeBall {
    static constexpr double kRadius = 15.3, kIrisRadius = 6.0, kCorneaRise = 1.2;  // mm
    Eigen::Vector3d centre;                                                        // mm

    // angle: from straight ahead, radians.
    static double radius_at(double angle) {
        const double edge = std::asin(kIrisRadius / kRadius);
        const double t = std::clamp(angle / (1.15 * edge), 0.0, 1.0);
        return kRadius + kCorneaRise * (1 - t * t) * (1 - t * t);
    }
};

inline EyeBall eye_ball(double side) { return {{side * 31.2, 71.0, -26.7}}; }  // +1: the talker's left

}  // namespace viaface
