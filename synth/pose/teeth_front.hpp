// The front of the teeth, which stops the lips.
#pragma once

#include "synth/pose/inside.hpp"

namespace viaface {

// Read off the nodes of the teeth at rest: foremost place at the middle, fall with x^2, height of the edges.
// side: as TeethFront's.
TeethFront teeth_front(const Nodes& rest, const FacePart& teeth, double side);

TeethFront moved_front(TeethFront front, const JawMotion& jaw);

}  // namespace viaface
