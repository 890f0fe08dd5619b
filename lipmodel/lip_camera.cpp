#include "lipmodel/lip_camera.hpp"

#include <Eigen/Geometry>
#include <stdexcept>

namespace viaface {

Eigen::Matrix3d camera_from_head(const LipPose& pose) {
    const double angle = pose.turn.norm();
    const Eigen::Vector3d axis = angle > 0 ? Eigen::Vector3d(pose.turn / angle) : Eigen::Vector3d::UnitX();
    return Eigen::AngleAxisd(angle, axis).toRotationMatrix() * Eigen::Vector3d(1, -1, -1).asDiagonal() *
           pose.scale.asDiagonal();
}

Projected project(const Pinhole& camera, const LipPose& pose, const Nodes& points) {
    constexpr double kNearest = 1;  // mm
    Projected made;
    made.in_camera = (points * camera_from_head(pose).transpose()).rowwise() + pose.shift.transpose();
    if (!(made.in_camera.col(2).minCoeff() > kNearest))
        throw std::runtime_error("project: the lips are not before the camera");
    const auto depth = made.in_camera.col(2).array();
    made.pixels.resize(points.rows(), 2);
    for (int axis = 0; axis < 2; ++axis) {
        made.pixels.col(axis) =
            camera.centre_px[axis] + camera.focal_px * made.in_camera.col(axis).array() / depth;
    }
    return made;
}

Eigen::Matrix<double, 2, 3> pinhole_slope(const Pinhole& camera, const Eigen::Vector3d& in_camera) {
    const double per_mm = camera.focal_px / in_camera.z();
    Eigen::Matrix<double, 2, 3> slope;
    slope << per_mm, 0, -per_mm * in_camera.x() / in_camera.z(), 0, per_mm,
        -per_mm * in_camera.y() / in_camera.z();
    return slope;
}

}  // namespace viaface
