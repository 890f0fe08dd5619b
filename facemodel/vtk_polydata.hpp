// VTK's legacy polydata, text and binary (big endian), file versions 1 to 5: points, polygons, triangle
// strips and the points' texture coordinates; lines, vertices and every other attribute are passed over.
// Format: W. Schroeder, K. Martin, B. Lorensen, "The Visualization Toolkit", VTK File Formats; version 5
// keeps cells as OFFSETS and CONNECTIVITY.
#pragma once

#include <span>

#include "facemodel/scan_mesh.hpp"

namespace viaface {

// InputError("scan", ...) naming line and byte for what is no such file.
ScanMesh parse_vtk(std::span<const std::uint8_t> bytes);

}  // namespace viaface
