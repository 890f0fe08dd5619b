// From the points that are measured to what they imply. [ATR98, eqs. 8-12]
//   t = mean_t + A (p - mean_p),  A = T0 P0^t (P0 P0^t + K sigma^2 I)^-1
// for the coefficients alpha of a face (t) out of its markers (p), and for the lip contours out of the 16 lip
// points. Departure: P0 P0^t of eq. 12 is 54 x 54 of rank below K and has no inverse. With sigma = 0 ours is
// its pseudo-inverse; sigma > 0 is the standard deviation of a coordinate's noise, a ridge that keeps points
// which vary little over the postures from being amplified. Both come from one singular value decomposition:
// P0 = U s V^t, A = T0 V diag(s / (s^2 + K sigma^2)) U^t. Only the points that are present enter it.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace viaface {

struct EstimatorOptions {
    double noise_mm = 0;      // sigma, mm; 0 for the pseudo-inverse
    double tolerance = 1e-9;  // singular values below this part of the largest are dropped
};

// Which points are there: all three of their coordinates are finite. [points]
using Presence = std::vector<bool>;
Presence presence_of(const Eigen::VectorXd& points);  // [3 x points]

// The estimator for one pattern of presence. Immutable.
class EstimatorFor {
  public:
    Eigen::VectorXd estimate(const Eigen::VectorXd& points) const;  // [3 x points], mm -> [targets]
    const Eigen::MatrixXd& matrix() const { return matrix_; }       // A [targets x present coordinates]
    const Presence& presence() const { return presence_; }
    int rank() const { return rank_; }

  private:
    friend class LinearEstimator;
    Presence presence_;
    std::vector<int> coordinates_;  // those of the points present
    Eigen::VectorXd mean_points_;   // [present coordinates]
    Eigen::VectorXd mean_targets_;
    Eigen::MatrixXd matrix_;
    int rank_ = 0;
};

// The training pairs, and an estimator for every pattern of presence asked for. Immutable: safe from any
// thread.
class LinearEstimator {
  public:
    // points: [3 x points, K], mm; targets: [targets, K]; one posture per column, all finite.
    // std::invalid_argument when they do not match.
    LinearEstimator(Eigen::MatrixXd points, Eigen::MatrixXd targets, EstimatorOptions options = {});

    // Factors anew; keep the result while the pattern lasts. std::invalid_argument when no point is present.
    EstimatorFor for_presence(const Presence& present) const;
    // Factors for the points that are not NaN, once.
    Eigen::VectorXd estimate(const Eigen::VectorXd& points) const;

    const Eigen::MatrixXd& points() const { return points_; }
    const Eigen::MatrixXd& targets() const { return targets_; }
    const EstimatorOptions& options() const { return options_; }

  private:
    Eigen::MatrixXd points_, targets_;
    EstimatorOptions options_;
};

}  // namespace viaface
