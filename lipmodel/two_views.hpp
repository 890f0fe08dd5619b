// Points in space from two calibrated views: linear triangulation [HartleyZisserman04, section 12.2, the
// inhomogeneous kind, for points on a face are not at infinity]. Each view gives two planes, u P_3 - P_1 and
// v P_3 - P_2; the place is the one with the least squared distances from the four.
#pragma once

#include <Eigen/Core>

namespace viaface {

using Projection = Eigen::Matrix<double, 3, 4>;  // image_from_head: homogeneous px from homogeneous mm

struct Triangulated {
    Eigen::Vector3d place;  // mm, head frame
    double error_px = 0;    // rms distance of its images from the points seen
};

Eigen::Vector2d projected(const Projection& view, const Eigen::Vector3d& place);  // px

// std::runtime_error when the rays do not meet in one place (the cameras look along one line).
Triangulated triangulate(const Projection& first, const Eigen::Vector2d& in_first, const Projection& second,
                         const Eigen::Vector2d& in_second);

}  // namespace viaface
