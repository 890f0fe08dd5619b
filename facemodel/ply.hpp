// PLY scans: text, and binary of either byte order. Of the element "vertex" x y z, texture coordinates (s t,
// u v, texture_u texture_v) and red green blue are kept, of "face" vertex_indices and texcoord, "tristrips"
// are cut; everything else is passed over. A line "comment TextureFile NAME" names the colour picture.
// Format: G. Turk, "The PLY Polygon File Format", 1994.
#pragma once

#include <span>

#include "facemodel/scan_mesh.hpp"

namespace viaface {

// InputError("scan", ...) naming line and byte for what is no PLY scan.
ScanMesh parse_ply(std::span<const std::uint8_t> bytes);

}  // namespace viaface
