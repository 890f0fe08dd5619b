// A face as binary glTF 2.0 (face.glb). A mesh per part; the principal components (one standard deviation at
// weight 1) and the named shapes are morph targets of the parts they move; textures are PNG. The scene's root
// scales mm to glTF's metres. What glTF has no place for (drives, weld, mean, variances, lip grid, hinge) is
// in extras.viaface of the asset and in accessors that it names. Places are rounded to 32-bit floats.
#pragma once

#include <span>
#include <string>

#include "base/bytes.hpp"
#include "facemodel/face.hpp"

namespace viaface {

Bytes write_glb(const Face& face, const std::string& copyright);

enum class Textures {
    kRead,
    kLeft
};  // left: a face to be measured, not drawn, is read in a third of the time

// Reads what write_glb writes. InputError("face", what was met, what is allowed) for anything else.
Face read_glb(std::span<const std::uint8_t> bytes, Textures textures = Textures::kRead);

}  // namespace viaface
