// The turn that carries one set of points best onto another: B. K. P. Horn, Closed-Form Solution of Absolute
// Orientation Using Unit Quaternions [Horn87]. With M the 3x3 matrix of sums of products of the centred
// coordinates, the quaternion is the eigenvector of the largest eigenvalue of the symmetric 4x4 matrix N of
// Horn's section 4.A. Scale is left out: heads do not grow.
#pragma once

#include <Eigen/Geometry>
#include <vector>

namespace viaface {

struct RigidTurn {
    Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();
    Eigen::Vector3d shift = Eigen::Vector3d::Zero();  // mm: to = turn * from + shift
    double residual_mm = 0;                           // rms over the points

    Eigen::Vector3d operator()(const Eigen::Vector3d& from) const { return turn * from + shift; }
    Eigen::Vector3d undone(const Eigen::Vector3d& to) const { return turn.conjugate() * (to - shift); }
};

using Points = std::vector<Eigen::Vector3d>;

// std::invalid_argument for fewer than three points, or other numbers of points. Points on a line leave a
// turn about it open: see spread().
RigidTurn rigid_turn(const Points& from, const Points& to);

// How far the points reach across the line that runs best through them: rms, mm; 0 for points on a line.
double spread(const Points& points);

}  // namespace viaface
