#include "lipmodel/closed_lips.hpp"

#include <algorithm>

#include "base/decompositions.hpp"

namespace viaface {
namespace {

// The inverse of a covariance along the directions in which it is one.
Eigen::Matrix3d inverse_where_it_moves(const Eigen::Matrix3d& covariance) {
    constexpr double kShare = 1e-6, kStill = 1e-6;  // of the largest; mm^2
    const auto [values, vectors] = symmetric_eigen(covariance);
    const double least = std::max(kStill, kShare * values[2]);
    const Eigen::Vector3d inverse =
        values.unaryExpr([&](double value) { return value > least ? 1 / value : 0.0; });
    return vectors * inverse.asDiagonal() * vectors.transpose();
}

}  // namespace

Eigen::Vector3d marked_openings(const Eigen::VectorXd& shape) {
    const auto height = [&](int column) { return shape[3 * LipMesh::node(LipMesh::kInnerRing, column) + 1]; };
    Eigen::Vector3d openings;
    for (int i = 0; i < 3; ++i) {
        const int column = (i - 1) * LipMesh::kLeftCorner / 2;
        openings[i] = height(column) - height(LipMesh::kBottom - column);
    }
    return openings;
}

ClosedLips closed_lips(const LipModel& model) {
    constexpr double kFree = 1e-9;  // of the largest variance
    const Eigen::Index modes = model.modes.cols();
    Eigen::MatrixXd slope(3, modes);
    for (Eigen::Index i = 0; i < modes; ++i) slope.col(i) = marked_openings(model.modes.col(i));
    const Eigen::Vector3d still = marked_openings(as_column(model.rest) + model.mean);
    const Eigen::MatrixXd spread = model.variance.asDiagonal() * slope.transpose();
    const Eigen::MatrixXd gain = spread * inverse_where_it_moves(slope * spread);

    ClosedLips closed{.model = model, .at = -gain * still};
    const Eigen::MatrixXd covariance =
        Eigen::MatrixXd(model.variance.asDiagonal()) - gain * spread.transpose();
    const SymmetricEigen free = symmetric_eigen(covariance);
    const Eigen::VectorXd values = free.values.reverse();
    const Eigen::Index kept = (values.array() > kFree * model.variance.maxCoeff()).count();
    closed.turn = free.vectors.rowwise().reverse().leftCols(kept);
    closed.cost = 0.5 * closed.at.cwiseAbs2().cwiseQuotient(model.variance).sum();
    closed.model.mean += model.modes * closed.at;
    closed.model.modes = model.modes * closed.turn;
    closed.model.variance = values.head(kept);
    return closed;
}

}  // namespace viaface
