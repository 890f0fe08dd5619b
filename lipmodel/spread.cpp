#include "lipmodel/spread.hpp"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <vector>

namespace viaface {
namespace {

std::vector<Eigen::Index> freedoms_of(std::span<const int> points) {
    std::vector<Eigen::Index> found;
    for (const int point : points) {
        for (int axis = 0; axis < 3; ++axis) found.push_back(3 * point + axis);
    }
    return found;
}

// Columns of K^-1 at the points: P^t, for K is symmetric.
Eigen::MatrixXd compliance(const GroundedBody& body, const std::vector<Eigen::Index>& at) {
    Eigen::MatrixXd unit = Eigen::MatrixXd::Zero(body.freedoms(), static_cast<Eigen::Index>(at.size()));
    for (std::size_t i = 0; i < at.size(); ++i) unit(at[i], static_cast<Eigen::Index>(i)) = 1;
    return body.displacements(unit);
}

}  // namespace

Eigen::MatrixXd least_force_spread(const GroundedBody& body, std::span<const int> points) {
    // P^t = Q R, hence P^t (P P^t)^-1 = Q R^-t: P P^t would square the condition number.
    const Eigen::HouseholderQR<Eigen::MatrixXd> qr(compliance(body, freedoms_of(points)));
    const Eigen::Index goals = qr.matrixQR().cols();
    const Eigen::MatrixXd q = qr.householderQ() * Eigen::MatrixXd::Identity(body.freedoms(), goals);
    const Eigen::MatrixXd r = qr.matrixQR().topRows(goals).triangularView<Eigen::Upper>();
    return r.triangularView<Eigen::Upper>().solve(body.displacements(q).transpose()).transpose();
}

Eigen::MatrixXd least_energy_spread(const GroundedBody& body, std::span<const int> points) {
    const auto at = freedoms_of(points);
    const Eigen::MatrixXd p_transposed = compliance(body, at);
    const Eigen::MatrixXd at_points = p_transposed(at, Eigen::all);
    return at_points.ldlt().solve(p_transposed.transpose()).transpose();
}

}  // namespace viaface
