// Two shapes that no motion of points on one face can teach: another person's upper and lower lip are
// thicker or thinner than the model's, and roll in and out. Added to the modes as two more, orthogonal to
// them. Departure: the paper fits its model to a talker by three scales alone.
#pragma once

#include "lipmodel/modes.hpp"

namespace viaface {

inline constexpr int kThicknessModes = 2;  // upper, lower

// sd_mm: how far the middle of a border moves from its inner edge, standard deviation.
LipModel with_thickness(const LipModel& model, double sd_mm);

}  // namespace viaface
