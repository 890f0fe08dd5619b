#include "viapoints/rigid_turn.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <stdexcept>

namespace viaface {
namespace {

Eigen::Vector3d mean_of(const Points& points) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& point : points) sum += point;
    return sum / static_cast<double>(points.size());
}

Eigen::Matrix4d horns_matrix(const Eigen::Matrix3d& s) {
    Eigen::Matrix4d n;
    n << s(0, 0) + s(1, 1) + s(2, 2), s(1, 2) - s(2, 1), s(2, 0) - s(0, 2), s(0, 1) - s(1, 0),  //
        s(1, 2) - s(2, 1), s(0, 0) - s(1, 1) - s(2, 2), s(0, 1) + s(1, 0), s(2, 0) + s(0, 2),   //
        s(2, 0) - s(0, 2), s(0, 1) + s(1, 0), s(1, 1) - s(0, 0) - s(2, 2), s(1, 2) + s(2, 1),   //
        s(0, 1) - s(1, 0), s(2, 0) + s(0, 2), s(1, 2) + s(2, 1), s(2, 2) - s(0, 0) - s(1, 1);
    return n;
}

}  // namespace

RigidTurn rigid_turn(const Points& from, const Points& to) {
    if (from.size() != to.size() || from.size() < 3)
        throw std::invalid_argument("a turn needs the same three or more points twice");
    const Eigen::Vector3d from_mean = mean_of(from), to_mean = mean_of(to);
    Eigen::Matrix3d sums = Eigen::Matrix3d::Zero();
    for (std::size_t i = 0; i < from.size(); ++i)
        sums += (from[i] - from_mean) * (to[i] - to_mean).transpose();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> solver(horns_matrix(sums));
    Eigen::Vector4d q = solver.eigenvectors().col(3);  // w x y z of the largest eigenvalue
    if (q[0] < 0) q = -q;
    RigidTurn result;
    result.turn = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized();
    result.shift = to_mean - result.turn * from_mean;
    double squares = 0;
    for (std::size_t i = 0; i < from.size(); ++i) squares += (result(from[i]) - to[i]).squaredNorm();
    result.residual_mm = std::sqrt(squares / static_cast<double>(from.size()));
    return result;
}

double spread(const Points& points) {
    const Eigen::Vector3d mean = mean_of(points);
    Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
    for (const Eigen::Vector3d& point : points) squares += (point - mean) * (point - mean).transpose();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(squares, Eigen::EigenvaluesOnly);
    return std::sqrt(std::max(0.0, solver.eigenvalues()[1]) / static_cast<double>(points.size()));
}

}  // namespace viaface
