// The most probable lip shape, climbed to from a first one. [Basu98, section 5.4, eq. 25]
//   theta <- theta + beta ascent(theta); where the full posterior would fall, beta is halved until it does
//   not.
// Departure: the direction is the gradient in the metric of lip_posterior.hpp, so that beta begins at 1.
#pragma once

#include "lipmodel/lip_posterior.hpp"

namespace viaface {

struct AscentOptions {
    int iterations = 20;       // at most
    int halvings = 8;          // of beta, until the climb has ended
    double least_gain = 0.01;  // of log probability: a step that gains less is the last
};

struct LipFit {
    Eigen::VectorXd theta;             // of the posterior
    double log_posterior = 0;          // but for the constant D
    int iterations = 0;                // steps taken
    bool ended = false;                // at a maximum; false when the iterations ran out
    std::vector<double> climbed = {};  // log posterior at the start and after each step
};

LipFit climb(const LipPosterior& posterior, const Eigen::VectorXd& start, const AscentOptions& options = {});

}  // namespace viaface
