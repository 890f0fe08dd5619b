// A part of the talker before it joins the face: its own nodes, texture places and triangles.
#pragma once

#include <string>
#include <vector>

#include "facemodel/face.hpp"

namespace viaface {

using Uvs = Eigen::Matrix<float, Eigen::Dynamic, 2, Eigen::RowMajor>;

struct PartMesh {
    std::string name;
    Material material = Material::kSkin;
    Drive drive = Drive::kFixed;
    Nodes nodes;                      // [n x 3], mm
    Uvs uvs;                          // [n x 2]
    std::vector<Triangle> triangles;  // indices into nodes
};

}  // namespace viaface
