// The talker's textures, painted once when the talker is made: every material's triangles are laid out in its
// own texture, and each texel is painted by where on the resting head without identity it falls; how open it
// lies is the talker's own. No picture of anyone is used:
// colours, hair, brows, stubble, irises, creases and pores are procedural, their noise seeded.
#pragma once

#include <array>

#include "facemodel/face.hpp"
#include "synth/training/looks.hpp"

namespace viaface {

// The 68 places of the usual annotation at rest, mm, head frame; 0 to 16 the jaw from the talker's right, 17
// to 26 brows, 27 to 35 nose, 36 to 47 eyes, 48 to 67 lips.
using Landmarks = std::array<Eigen::Vector3d, 68>;

// Fills face.surfaces. canvas: the face of the head without identity, of the same parts and uvs; landmarks:
// on it.
void bake_surfaces(Face& face, const Face& canvas, const Landmarks& landmarks, const Looks& looks = {});

}  // namespace viaface
