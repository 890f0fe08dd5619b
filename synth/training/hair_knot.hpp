// A knot of tied hair as a part of the face: an ellipsoid that turns with the head. Its texture is a corner
// of the skin's that no chart covers.
#pragma once

#include "synth/training/looks.hpp"
#include "synth/training/part_mesh.hpp"

namespace viaface {

PartMesh hair_knot(const HairKnot& knot);

}  // namespace viaface
