// Lips in a picture: a pinhole camera, a rigid pose and three scales that fit the lips to a talker.
// [Basu98, section 5.2]
//   X_c = R(turn) D (scale * X) + shift, D = diag(1, -1, -1);   (x, y) = centre + focal (X_c, Y_c) / Z_c
// The camera's frame: x to the picture's right, y down, z away from the camera. With turn = 0 the talker
// faces it. X is in the head frame, mm.
#pragma once

#include <Eigen/Core>

#include "lipmodel/lip_mesh.hpp"

namespace viaface {

struct Pinhole {
    double focal_px = 0;
    Eigen::Vector2d centre_px = Eigen::Vector2d::Zero();
};

struct LipPose {
    Eigen::Vector3d turn = Eigen::Vector3d::Zero();   // axis times angle, radians, camera frame
    Eigen::Vector3d shift = Eigen::Vector3d::Zero();  // mm, camera frame: where the head's origin is
    Eigen::Vector3d scale = Eigen::Vector3d::Ones();  // of x, y and z of the head frame
};

Eigen::Matrix3d camera_from_head(const LipPose& pose);  // R D diag(scale)

using Pixels = Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>;  // [points x 2], px

struct Projected {
    Nodes in_camera;  // [points x 3], mm, camera frame
    Pixels pixels;    // [points x 2]
};

// std::runtime_error when a point lies less than 1 mm before the camera.
Projected project(const Pinhole& camera, const LipPose& pose, const Nodes& points);

// d(x, y)/dX_c at a point of the camera frame, px per mm.
Eigen::Matrix<double, 2, 3> pinhole_slope(const Pinhole& camera, const Eigen::Vector3d& in_camera);

}  // namespace viaface
