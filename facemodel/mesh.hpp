// Polygon meshes of a face. A shape is the nodes alone; shapes of one mesh share its polygons.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace viaface {

using Nodes = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;  // [nodes x 3], mm, head frame
using Triangle = std::array<int, 3>;  // counter-clockwise seen from outside
using Polygon = std::array<int, 4>;   // as Triangle; the last is -1 for a triangle

struct Mesh {
    Nodes nodes;
    std::vector<Polygon> polygons;
};

struct TriangleMesh {
    Nodes nodes;
    std::vector<Triangle> triangles;
};

}  // namespace viaface
