// Where hair grows on the head, and how far it stands off the scalp: hair with a soft, uneven line. Places
// are those of the resting head without identity, mm.
#pragma once

#include <Eigen/Core>

#include "synth/training/looks.hpp"

namespace viaface {

// mm behind the hairline, < 0 in front of it.
float hair_depth(const HairStyle& style, const Eigen::Vector3f& place);

float hair_thickness(const HairStyle& style, const Eigen::Vector3f& place);  // mm

// Where the pattern of its hairs is looked up: the place itself, or, combed to a knot, mm across and, far
// slower, along.
Eigen::Vector3f strand_place(const HairStyle& style, const Eigen::Vector3f& place);

}  // namespace viaface
