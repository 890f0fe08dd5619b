// What units that are alike agree on. Recordings differ by chance, tracked ones most: a phone's motion in its
// context is estimated from up to kMostAlike units of the phone by ordinary kriging [Matheron63] over their
// contexts. Where d is unlikeness() and s the scatter, both in mm, two units are taken to differ by
//   gamma(a, b) = s + d(a, b), gamma(a, a) = 0
// and the weights w, which sum to 1, make the expected error of sum_i w_i motion_i least. Without scatter a
// unit of just this context speaks alone, and the others go between; much of it makes all nearly equal.
// Departure: s is not read off a variogram but chosen by leaving recitations out.
//
// Motions are set side by side by relative time in the phone, closures by their nuclei too, pauses by seconds
// from the speech beside them.
#pragma once

#include "viapoints/codex_select.hpp"

namespace viaface {

inline constexpr std::size_t kMostAlike = 32;

// The least unlike ones; ties go to the unit that stands first in the codex.
struct AlikeUnits {
    std::vector<std::int32_t> units;  // indices into codex.units
    Eigen::VectorXd to_asked;         // [units], mm
    Eigen::MatrixXd between;          // [units x units], mm
};

// Of the phone, without one recitation (none: -1); of a pause those that lead to speech as it does, or follow
// it.
AlikeUnits alike_units(const Codex& codex, PhoneId centre, const PhoneContext& asked,
                       std::int32_t without_recitation = -1);

Eigen::VectorXd kriging_weights(const AlikeUnits& alike, double scatter_mm);  // [units], their sum is 1

// Instants of a phone.
struct PhoneInstants {
    std::vector<double> at;  // [0, 1]: relative to it
    double nucleus = 0;      // likewise
    double duration_s = 0;
};

// [instants x k], components: the weighted mean of the units' motions. The codex has to have a scatter.
RowMatrix agreed_motion(const Codex& codex, const AlikeUnits& alike, const Eigen::VectorXd& weights,
                        const PhoneInstants& instants);

// The nearest place, components, where the lips press each other by as much, from where they are at rest: how
// p, b and m are spoken though no frame of a film caught them closed. Pressed, they touch for longer than an
// instant.
inline constexpr double kPressedLips = 2;  // mm
Eigen::RowVectorXd with_lips_together(const Codex& codex, const Eigen::RowVectorXd& components);

// The codex with the scatter with which its phones are best told from the other recitations: the least of
// kScatters that does not tell significantly more recitations worse than the one of least mean squared error
// does. Few recitations tell little, and a single one nothing: 0, and they say themselves.
inline constexpr double kScatters[] = {0, 0.25, 0.5, 1, 2, 4, 8};  // mm
Codex with_scatter(Codex codex);

}  // namespace viaface
