#include "lipmodel/spread.hpp"

#include <vector>

#include "base/decompositions.hpp"

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
    const auto [q, r] = thin_qr(compliance(body, freedoms_of(points)));
    return r.triangularView<Eigen::Upper>().solve(body.displacements(q).transpose()).transpose();
}

Eigen::MatrixXd least_energy_spread(const GroundedBody& body, std::span<const int> points) {
    const auto at = freedoms_of(points);
    const Eigen::MatrixXd p_transposed = compliance(body, at);
    const Eigen::MatrixXd at_points = p_transposed(at, Eigen::all);
    return solve_positive(at_points, Eigen::MatrixXd(p_transposed.transpose())).transpose();
}

}  // namespace viaface
