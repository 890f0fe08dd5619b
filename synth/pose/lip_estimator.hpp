// The 16 lip points to the middle and the inner contour of the lips: contours = rest + W d + E d, where d are
// the points' displacements, W spreads them along the contours by closed cubic splines, and E, learned from
// the postures with a ridge, is what W leaves out. The elastic lip mesh of lipmodel/ would lead from the
// points to the contours too [Basu98, eqs. 2-4]: on momo's 23 postures, each left out in turn, the inner
// contour is then 0.66 mm rms from the scans' (0.77 mm through ten modes learned from the others), and 0.22
// mm by this estimator, which learns what an elastic sheet does not know: how these lips roll. In a spoken
// sentence of p, b, m, f and v, after contact, all four built-in talkers' inner lips lie 0.45 to 0.46 mm rms
// from their points by this estimator and 0.48 to 0.49 mm through mesh or modes; closures are the same, and
// neither passes through the other (tests/synth/lips/drawn_lips_test.cpp). So it is what draws them.
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
