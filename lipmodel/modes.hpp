// Lip shapes as they were seen to move: shape = rest + mean + S p, p of a Gaussian with variances lambda.
// [Basu98, section 4.2] The displacements of all nodes that follow from the marked points (spread.hpp) have
// the sample covariance R_u; its eigenvectors are the modes S, its eigenvalues lambda the modal prior.
//   R_u = K^-2 (eq. 5), hence the learned K^-1 = S lambda^(1/2) S^t,
//   log f(p) = C - 1/2 sum p_i^2 / lambda_i (eqs. 14-16).
// Departure: a mode whose variance lies below what noise of the points alone would give along it is dropped,
// however many are asked for; no mode is ever divided by.
#pragma once

#include "lipmodel/lip_body.hpp"

namespace viaface {

struct LipModel {
    Nodes rest;                 // [204 x 3], mm, head frame
    Eigen::VectorXd mean;       // [612], mm: mean displacement from rest
    Eigen::MatrixXd modes;      // S [612 x M], orthonormal, by falling variance
    Eigen::VectorXd variance;   // lambda [M], mm^2
    double total_variance = 0;  // trace of R_u, mm^2
    double left_over = 0;       // mm^2: variance of a coordinate of a marked point that the modes leave out
    double noise_mm = 0;        // standard deviation of such a coordinate's noise, as stated in training
    int frames = 0;             // learned from
    std::string provenance;     // one line of text: whose lips
};

struct LipTraining {
    int modes = 10;          // at most
    double noise_mm = 0.02;  // standard deviation of a coordinate of a marked point; retargeted ones have
                             // none but rounding, measured ones a tenth of a millimetre or more
};

// frames: [48 x frames] of finite points, mm. std::runtime_error when nothing moves above the noise.
LipModel learn_lips(const LipBody& body, const Eigen::MatrixXd& frames, const LipTraining& training = {});

// How many modes of the frames lie above the noise: what the data carry.
int carried_modes(const LipBody& body, const Eigen::MatrixXd& frames, double noise_mm);

// Marked points [48 x frames] with the model's mean and covariance, about as many as it was learned from,
// each by 2 M at least: to go on learning from a model whose own frames are gone [Basu98, 6.3]. They stand on
// each mode at sqrt(M lambda) either side of the mean.
Eigen::MatrixXd frames_like(const LipModel& model);

// The first of a model's modes, no more than it has: from robustness (few) to accuracy (many) [Basu98, 6.3].
// What the others carried is left over.
LipModel with_modes(const LipModel& model, int modes);

Eigen::VectorXd lip_shape(const LipModel& model, const Eigen::VectorXd& p);         // [612], mm, head frame
Eigen::VectorXd lip_modes_of(const LipModel& model, const Eigen::VectorXd& shape);  // p of the nearest shape

double log_prior(const LipModel& model, const Eigen::VectorXd& p);                    // eqs. 14-16, with C
Eigen::VectorXd log_prior_gradient(const LipModel& model, const Eigen::VectorXd& p);  // eq. 24

// Learned physics: the displacement from the mean shape under forces [612] (eq. 5).
Eigen::VectorXd learned_displacement(const LipModel& model, const Eigen::VectorXd& forces);

}  // namespace viaface
