// The tongue as a part of the face: u round a section from the top, v from the tip (0) to the root (1).
#pragma once

#include "synth/training/part_mesh.hpp"

namespace viaface {

PartMesh tongue();
PartMesh mouth_lining(const Nodes& lining);  // u along the lips, v inwards

}  // namespace viaface
