// Lips that are shut: a model under the condition that its inner edges meet. Modes p of a Gaussian with
// variances Lambda, openings of the marked inner edges o = o_0 + C p; given o = 0, p is of a Gaussian too,
//   p = m + V q,  m = -Lambda C^t (C Lambda C^t)^+ o_0,  Lambda - Lambda C^t (C Lambda C^t)^+ C Lambda = V S
//   V^t,
// so that what is free still, q of variances S, is a lip model of its own. The log prior of p is that of q
// less m^t Lambda^-1 m / 2. Departure: the paper knows no contact. The dark line where lips meet has the
// opening's colour, and a mode that opens has no bound at zero: without this, lips that are shut are seen a
// little open.
#pragma once

#include "lipmodel/modes.hpp"

namespace viaface {

struct ClosedLips {
    LipModel model;             // of q
    Eigen::VectorXd at = {};    // m [M]
    Eigen::MatrixXd turn = {};  // V [M x K], orthonormal
    double cost = 0;            // m^t Lambda^-1 m / 2

    Eigen::VectorXd modes_of(const Eigen::VectorXd& q) const { return at + turn * q; }
    Eigen::VectorXd nearest(const Eigen::VectorXd& p) const { return turn.transpose() * (p - at); }  // q
};

ClosedLips closed_lips(const LipModel& model);

// Heights of the opening of a shape [612] at its three marked pairs of inner edges, mm; below zero where they
// have passed through each other.
Eigen::Vector3d marked_openings(const Eigen::VectorXd& shape);

}  // namespace viaface
