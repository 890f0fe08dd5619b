// What the rest of a body does when some of its nodes are moved to given places: displacement = S u_g, with
// S [freedoms x 3 points] from the body alone.
#pragma once

#include <span>

#include "lipmodel/grounded.hpp"

namespace viaface {

// With the least sum of squared forces [Basu98, eqs. 2-4]: minimise f'f where P f = u_g and P are the rows of
// K^-1 at the points; f = P^t (P P^t)^-1 u_g, S = K^-1 P^t (P P^t)^-1.
Eigen::MatrixXd least_force_spread(const GroundedBody& body, std::span<const int> points);

// With the least strain energy u'Ku / 2: forces at the points alone. What the paper's words "minimum strain"
// would give; it leaves a cusp at each point where the other is smooth.
Eigen::MatrixXd least_energy_spread(const GroundedBody& body, std::span<const int> points);

}  // namespace viaface
