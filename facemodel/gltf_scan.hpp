// Scans as glTF 2.0, binary (.glb) or text (.gltf) with buffers beside it or inside as data: every triangle
// primitive of every mesh of the scene, at its node's place, with TEXCOORD_0 where all have it, and the first
// base colour's picture. Skins, morph targets and animations are passed over;
// compressed and sparse data are refused.
#pragma once

#include <functional>
#include <span>

#include "facemodel/scan_mesh.hpp"

namespace viaface {

// The bytes of a file named beside the scan; throws InputError for what may not be read.
using FileBeside = std::function<Bytes(const std::string& name)>;

// InputError("scan", ...) naming what is wrong.
ScanMesh parse_gltf_scan(std::span<const std::uint8_t> bytes, const FileBeside& file_beside);

}  // namespace viaface
