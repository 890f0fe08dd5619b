// The 16 lip points to the middle and the inner contour of the lips: contours = rest + W d + E d, where d are
// the points' displacements, W spreads them along the contours by closed cubic splines, and E, learned from
// the postures with a ridge, is what W leaves out.
#pragma once

#include "facemodel/estimator.hpp"
#include "synth/pose/training.hpp"

namespace viaface {

class LipEstimator {
  public:
    // std::invalid_argument when the points do not follow each other round the lips.
    LipEstimator(const Nodes& rest, const LipGrid& lips, const PoseTraining& training);

    // points: [48], mm. The contours as in PoseTraining::contours: [240], mm.
    Eigen::VectorXd contours(const Eigen::VectorXd& points) const;

  private:
    Eigen::VectorXd spread_out(const Eigen::VectorXd& points) const;

    Eigen::MatrixXd spread_;  // [80 x 16]
    Eigen::VectorXd rest_points_, rest_;
    EstimatorFor residual_;
};

}  // namespace viaface
