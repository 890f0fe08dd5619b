// Principal components of an ensemble of shapes. [ATR98, eqs. 1-7]
//   F = [f_1 .. f_K], mu = row means, F0 = F - mu, C = F0 F0^t = U S U^t, alpha = U^t (f - mu), f = mu + U
//   alpha
// Departure: U and S come from the singular values of F0 itself (C is 3N x 3N of rank below K and is never
// formed); variance is S / K, so shares of the whole are the report's.
#pragma once

#include <Eigen/Core>

namespace viaface {

struct PrincipalComponents {
    Eigen::VectorXd mean;       // [3N], mm
    Eigen::MatrixXd modes;      // [3N x rank], orthonormal, falling variance; of the entries that tie for the
                                // largest magnitude of a mode the first is positive
    Eigen::VectorXd variance;   // [rank], mm^2, all positive
    double total_variance = 0;  // mm^2, over all modes, also those left out by a cap

    Eigen::VectorXd coefficients(const Eigen::VectorXd& shape) const;       // eq. 7: [3N] mm -> [rank] mm
    Eigen::VectorXd shape(const Eigen::VectorXd& coefficients) const;       // eqs. 3 and 6: [rank] -> [3N] mm
    Eigen::MatrixXd all_coefficients(const Eigen::MatrixXd& shapes) const;  // eq. 8: [3N x K] -> [rank x K]
    Eigen::VectorXd share() const;                                          // [rank], of the total variance
};

// Modes whose singular value is below this part of the largest are round-off, not shape.
inline constexpr double kRankTolerance = 1e-9;

// shapes: [3N x K], mm, one per column, K >= 1. Keeps at most `most` modes when it is not negative.
// std::invalid_argument for no columns, no rows or numbers that are not finite.
PrincipalComponents principal_components(const Eigen::MatrixXd& shapes, int most = -1,
                                         double rank_tolerance = kRankTolerance);

}  // namespace viaface
