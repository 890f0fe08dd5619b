// The eye's shape, a sphere with a cornea's bulge about the way it looks; and where eyes look.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "facemodel/mesh.hpp"

namespace viaface {

struct Gaze {
    double left = 0, up = 0;  // degrees from straight ahead, to the talker's left and up

    Eigen::Matrix3d turn() const {
        constexpr double kRadians = std::numbers::pi / 180;
        return (Eigen::AngleAxisd(left * kRadians, Eigen::Vector3d::UnitY()) *
                Eigen::AngleAxisd(-up * kRadians, Eigen::Vector3d::UnitX()))
            .toRotationMatrix();
    }
};

struct EyeBall {
    static constexpr double kRadius = 15.3, kIrisRadius = 6.0, kCorneaRise = 1.2;  // mm
    Eigen::Vector3d centre;                                                        // mm
    double size = 1;                                                               // times the measures above

    // angle: from the way it looks, radians.
    static double radius_at(double angle) {
        const double edge = std::asin(kIrisRadius / kRadius);
        const double t = std::clamp(angle / (1.15 * edge), 0.0, 1.0);
        return kRadius + kCorneaRise * (1 - t * t) * (1 - t * t);
    }
};

inline EyeBall eye_ball(double side) { return {{side * 31.2, 71.0, -26.7}}; }  // +1: the talker's left

// The eye that a face has, from the sphere through its nodes behind the cornea, to 0.01 mm: as near as floats
// in a file keep it. std::invalid_argument when the nodes are no such eye.
EyeBall eye_ball_of(const Nodes& eye);

}  // namespace viaface
