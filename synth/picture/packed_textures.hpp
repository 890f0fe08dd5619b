// The textures of a material as the shading reads them. Two are read where glTF has three: colour with
// occlusion (or the lashes' cover), and the normal's slopes with roughness and thinness.
#pragma once

#include "facemodel/face.hpp"

namespace viaface {

using Surfaces = decltype(Face::surfaces);  // of all materials

struct PackedTextures {
    Texture base;    // R, G, B sRGB; A occlusion or cover
    Texture detail;  // R, G slopes; B roughness; A thinness. As large as base.
};

PackedTextures pack(const Surface& surface, Material material);

}  // namespace viaface
