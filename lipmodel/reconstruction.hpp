// The whole lip shape from some coordinates of the marked points. [Basu98, section 6.1, Table 1]
//   p = (S_o^t S_o + s^2 lambda^-1)^-1 S_o^t (o - o_mean),
// the most probable p when the observed coordinates o = o_mean + S_o p + noise of variance s^2. Departure:
// the paper does not say how it weighs what its modes leave out; ours is noise, with its variance in training
// [TippingBishop99]. With s = 0: least squares without a prior.
#pragma once

#include <span>

#include "lipmodel/modes.hpp"

namespace viaface {

enum class LipView { kFrontal, kProfile };        // x and y are seen; y and z are seen
std::vector<int> coordinates_seen(LipView view);  // of the 48 of the marked points

// Immutable.
class ModeEstimator {
  public:
    // seen: which of the 48 coordinates; variance: s^2, mm^2.
    ModeEstimator(const LipModel& model, std::span<const int> seen, double variance);

    // p [M x frames] of the frames' coordinates that are seen; the others are not looked at. [48 x frames]
    Eigen::MatrixXd modes(const Eigen::MatrixXd& frames) const;

  private:
    std::vector<int> seen_;
    Eigen::VectorXd centre_;  // o_mean
    Eigen::MatrixXd gain_;    // [M x seen]
};

// Mean squared differences, mm^2, between what was reconstructed and where all coordinates together put it.
struct ReconstructionError {
    double mesh = 0;    // per degree of freedom of the mesh (612)
    double points = 0;  // per coordinate of the marked points (48)
};

struct ViewErrors {
    ReconstructionError frontal, profile;
};

ViewErrors reconstruction_errors(const LipBody& body, const LipModel& model, const Eigen::MatrixXd& frames);

// Learned from all frames but one of `folds` consecutive stretches, tried on that one, in turn; with 1, 2,
// ... training.modes modes, as far as the stretches carry them.
std::vector<ViewErrors> cross_validated(const LipBody& body, const Eigen::MatrixXd& frames,
                                        const LipTraining& training, int folds = 10);

// In the paper's units, where the mesh is scaled uniformly to a largest extent of 2.83.
inline constexpr double kPaperExtent = 2.83;
inline constexpr double kPaperFrontal = 6.70e-3, kPaperProfile = 7.13e-4;  // Table 1
double in_paper_units(double mean_square_mm2, const Nodes& rest);

}  // namespace viaface
