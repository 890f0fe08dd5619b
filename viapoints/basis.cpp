#include "viapoints/basis.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/decompositions.hpp"
#include "base/error.hpp"
#include "viapoints/measured.hpp"

namespace viaface {
namespace {

using Eigen::Index;

// Less variance than this share of the largest is rounding of the 114 x 114 covariance.
constexpr double kSmallestVarianceShare = 1e-13;

Eigen::VectorXd with_positive_peak(const Eigen::VectorXd& mode) {
    Index peak = 0;
    for (Index i = 1; i < mode.size(); ++i) {
        if (std::abs(mode[i]) > std::abs(mode[peak]) * (1 + 1e-9)) peak = i;
    }
    return mode[peak] < 0 ? Eigen::VectorXd(-mode) : mode;
}

// Modes in the packed coordinates of the measured points, most important first. Eigenvalues come rising.
Eigen::MatrixXd packed_modes(const RowMatrix& centred, Index wanted) {
    const auto [values, vectors] = symmetric_eigen(centred.transpose() * centred);
    const Index n = centred.cols();
    const double smallest = kSmallestVarianceShare * std::max(0.0, values[n - 1]);
    Index kept = 0;
    while (kept < std::min({wanted, n, centred.rows()}) && values[n - 1 - kept] > smallest) ++kept;
    Eigen::MatrixXd modes(n, kept);
    for (Index k = 0; k < kept; ++k) modes.col(k) = with_positive_peak(vectors.col(n - 1 - k));
    return modes;
}

ConfigurationBasis leading(const ConfigurationBasis& basis, Index modes) {
    return {basis.mean, basis.modes.leftCols(modes)};
}

}  // namespace

ConfigurationBasis principal_basis(const RowMatrix& training, Index modes) {
    if (modes < 0) throw std::invalid_argument("a basis has no negative number of modes");
    const std::vector<int> points = measured_points(training, "training");
    const RowMatrix packed = coordinates_of(training, points);
    const Eigen::RowVectorXd mean = packed.colwise().mean();
    const Eigen::MatrixXd packed_basis = packed_modes(packed.rowwise() - mean, modes);
    ConfigurationBasis basis{Configuration::Constant(std::numeric_limits<double>::quiet_NaN()),
                             Eigen::MatrixXd::Zero(kCoordinates, packed_basis.cols())};
    for (std::size_t i = 0; i < points.size(); ++i) {
        const auto from = static_cast<Index>(3 * i);
        basis.mean.segment<3>(3 * points[i]) = mean.segment<3>(from).transpose();
        basis.modes.middleRows<3>(3 * points[i]) = packed_basis.middleRows<3>(from);
    }
    return basis;
}

ConfigurationBasis choose_basis(const RowMatrix& training, const RowMatrix& held_out, double max_error_mm) {
    if (!(max_error_mm >= 0)) throw InputError("max_error_mm", std::to_string(max_error_mm), "0 or more");
    const ConfigurationBasis all = principal_basis(training, kCoordinates);
    for (Index k = 0; k <= all.size(); ++k) {
        const ConfigurationBasis basis = leading(all, k);
        if (truncation_error_mm(basis, held_out) <= max_error_mm) return basis;
    }
    throw InputError("max_error_mm", std::to_string(max_error_mm),
                     "at least " + std::to_string(truncation_error_mm(all, held_out)) + ", which all " +
                         std::to_string(all.size()) + " components of the training leave");
}

std::vector<int> points_of(const ConfigurationBasis& basis) {
    std::vector<int> points;
    for (int i = 0; i < kPoints; ++i) {
        if (point_of(basis.mean, i).allFinite()) points.push_back(i);
    }
    return points;
}

RowMatrix to_components(const ConfigurationBasis& basis, const RowMatrix& points) {
    if (points.cols() != kCoordinates) throw std::invalid_argument("configurations need 114 columns");
    const std::vector<int> held = points_of(basis);
    const RowMatrix packed = coordinates_of(points, held);
    if (!packed.allFinite()) throw std::invalid_argument("a configuration lacks a point which the basis has");
    const RowMatrix modes = coordinates_of(basis.modes.transpose(), held);
    const RowMatrix mean = coordinates_of(basis.mean.transpose(), held);
    return (packed.rowwise() - mean.row(0)) * modes.transpose();
}

RowMatrix to_points(const ConfigurationBasis& basis, const RowMatrix& components) {
    if (components.cols() != basis.size()) throw std::invalid_argument("components do not fit the basis");
    return (components * basis.modes.transpose()).rowwise() + basis.mean.transpose();
}

double truncation_error_mm(const ConfigurationBasis& basis, const RowMatrix& points) {
    return longest_triple(
        coordinates_of(points - to_points(basis, to_components(basis, points)), points_of(basis)));
}

}  // namespace viaface
