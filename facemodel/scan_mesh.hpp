// A scanned surface as a file gives it, whatever the format: nodes in the file's unit and axes, triangles,
// texture coordinates per corner, colours per node, and where its colour picture is.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/bytes.hpp"
#include "facemodel/mesh.hpp"
#include "facemodel/obj.hpp"

namespace viaface {

inline constexpr std::size_t kLargestScanNodes = 12'000'000, kLargestScanTriangles = 24'000'000;

struct ScanMesh {
    Nodes nodes;  // [nodes x 3], the file's unit and axes, finite
    std::vector<Triangle> triangles;
    Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor> uvs;  // v up
    std::vector<Triangle> uv_triangles;                // as triangles, into uvs; empty where there are none
    std::vector<std::array<std::uint8_t, 3>> colours;  // [nodes], sRGB; empty where there are none
    std::vector<std::string> pictures;                 // names of colour pictures, relative to the file
    Bytes picture;                                     // a colour picture inside the file: PNG or JPEG
};

// A polygon of any number of corners as a fan; `uvs` as corners, or empty.
void add_polygon(ScanMesh& mesh, const std::vector<int>& corners, const std::vector<int>& uvs);
// A triangle strip: every other triangle turned round.
void add_strip(ScanMesh& mesh, const std::vector<int>& corners);
// Every node its own texture place: uvs are those of the nodes.
void share_uvs_with_nodes(ScanMesh& mesh);

// InputError("scan", ...) for indices out of range, values that are not finite, too many of anything.
void check(const ScanMesh& mesh);

ScanMesh scan_mesh(const ObjScan& scan);

// One node of every cell of a cubic grid of side `cell`; triangles that vanish are left out.
ScanMesh thinned(const ScanMesh& mesh, double cell);

// Triangles joined over nodes are a piece; pieces by falling count of triangles, as indices of triangles.
std::vector<std::vector<int>> pieces_of(const ScanMesh& mesh);

}  // namespace viaface
