#include "facemodel/pca.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <stdexcept>

namespace viaface {
namespace {

// Left and right often tie up to round-off, so the largest entry alone would not name one place.
double sign_of(const Eigen::VectorXd& mode) {
    constexpr double kTie = 1 - 1e-6;
    const double largest = mode.cwiseAbs().maxCoeff();
    for (const double entry : mode) {
        if (std::abs(entry) >= kTie * largest) return entry < 0 ? -1.0 : 1.0;
    }
    return 1.0;
}

int rank_of(const Eigen::VectorXd& singular_values, double tolerance) {
    int rank = 0;
    while (rank < singular_values.size() && singular_values[rank] > tolerance * singular_values[0]) ++rank;
    return rank;
}

}  // namespace

Eigen::VectorXd PrincipalComponents::coefficients(const Eigen::VectorXd& shape) const {
    if (shape.size() != mean.size()) throw std::invalid_argument("coefficients: a shape of another size");
    return modes.transpose() * (shape - mean);
}

Eigen::VectorXd PrincipalComponents::shape(const Eigen::VectorXd& coefficients) const {
    if (coefficients.size() != modes.cols()) {
        throw std::invalid_argument("shape: coefficients of another number of modes");
    }
    return mean + modes * coefficients;
}

Eigen::MatrixXd PrincipalComponents::all_coefficients(const Eigen::MatrixXd& shapes) const {
    if (shapes.rows() != mean.size()) throw std::invalid_argument("all_coefficients: shapes of another size");
    return modes.transpose() * (shapes.colwise() - mean);
}

Eigen::VectorXd PrincipalComponents::share() const {
    return total_variance > 0 ? Eigen::VectorXd(variance / total_variance) : variance;
}

PrincipalComponents principal_components(const Eigen::MatrixXd& shapes, int most, double rank_tolerance) {
    if (shapes.size() == 0) throw std::invalid_argument("principal_components: no shapes");
    if (!shapes.allFinite()) throw std::invalid_argument("principal_components: a number that is not finite");
    PrincipalComponents found;
    found.mean = shapes.rowwise().mean();
    const Eigen::MatrixXd deviations = shapes.colwise() - found.mean;
    const Eigen::JacobiSVD<Eigen::MatrixXd, Eigen::HouseholderQRPreconditioner> svd(deviations,
                                                                                    Eigen::ComputeThinU);
    const double scale = std::max(1.0, shapes.cwiseAbs().maxCoeff());
    const bool all_equal = svd.singularValues()[0] <= rank_tolerance * scale;
    int rank = all_equal ? 0 : rank_of(svd.singularValues(), rank_tolerance);
    const Eigen::VectorXd variance =
        svd.singularValues().head(rank).array().square() / static_cast<double>(shapes.cols());
    found.total_variance = variance.sum();
    if (most >= 0) rank = std::min(rank, most);
    found.variance = variance.head(rank);
    found.modes = svd.matrixU().leftCols(rank);
    for (int i = 0; i < rank; ++i) found.modes.col(i) *= sign_of(found.modes.col(i));
    return found;
}

}  // namespace viaface
