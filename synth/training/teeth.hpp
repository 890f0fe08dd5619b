// Procedural teeth and gums: two arches of sixteen crowns, each a stack of rounded sections, set where the
// scan's teeth stand. A crown has a strip of the texture: u runs across it,
// v from the neck to the edge; front and back share it.
#pragma once

#include "synth/training/part_mesh.hpp"

namespace viaface {

PartMesh upper_teeth();
PartMesh lower_teeth();
PartMesh upper_gums();
PartMesh lower_gums();

}  // namespace viaface
