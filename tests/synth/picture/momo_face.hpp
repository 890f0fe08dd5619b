// The face of a built-in talker, read once.
#pragma once

#include "base/whole_file.hpp"
#include "facemodel/gltf.hpp"

namespace viaface::testing {

inline const Face& momo() {
    static const Face face =
        read_glb(read_bytes(std::filesystem::path(VIAFACE_SOURCE_DIR) / "talkers/momo/face.glb", "face"));
    return face;
}

}  // namespace viaface::testing
