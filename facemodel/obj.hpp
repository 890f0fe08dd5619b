// Wavefront OBJ scans: nodes, texture coordinates and polygons with their materials. Polygons of more than
// four corners are cut into a fan.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "facemodel/mesh.hpp"

namespace viaface {

struct ObjFace {
    Polygon nodes;      // indices from 0; the last is -1 for a triangle
    Polygon uvs;        // as nodes; all -1 where the file gives none
    int material = -1;  // index into ObjScan::materials
};

struct ObjScan {
    Nodes nodes;  // [nodes x 3], in the file's unit and axes
    Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor> uvs;
    std::vector<ObjFace> faces;
    std::vector<std::string> materials;  // in the order of their first use
    std::vector<std::string> libraries;  // files of materials (MTL) that the scan names
};

// InputError("scan", ...) naming the line for text that is not an OBJ scan: no nodes, indices out of range,
// numbers that do not parse or are not finite.
ObjScan parse_obj(std::string_view text);
ObjScan read_obj(const std::filesystem::path& path);

// Colour pictures (map_Kd) by material, of an MTL file; options before the name are passed over.
std::map<std::string, std::string> parse_mtl(std::string_view text);

}  // namespace viaface
