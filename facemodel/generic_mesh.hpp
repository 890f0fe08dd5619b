// The generic face mesh, exclusive of the lips: 576 nodes and 844 polygons, triangles and quads, in the
// unrolled plane of a cylinder. [ATR98, "Face and lip mesh adaptation", Figure 3a: counts, and nodes close
// together round the mouth, along the nose and round the eyes, sparse elsewhere] Made by rule: nodes on the
// feature contours and markers, then always one more where the mesh is coarsest for its place (left and right
// in pairs), Delaunay triangles, and the pairs that make the best quads merged. The mouth (within the outer
// lip contour) and the eyes are holes.
#pragma once

#include <array>

#include "facemodel/features.hpp"

namespace viaface {

struct GenericMesh {
    static constexpr int kNodes = 576, kPolygons = 844;

    Flat flat;                               // [576 x 2], mm
    std::vector<Polygon> polygons;           // counter-clockwise; a quad is convex, cut from corner 0 to 2
    std::array<int, kMarkers> markers{};     // the node at each marker
    std::vector<std::vector<int>> contours;  // the nodes on each of feature_contours(), in order
};

GenericMesh generic_mesh();

// Every polygon as triangles, quads cut from corner 0 to corner 2.
std::vector<Triangle> triangles_of(const std::vector<Polygon>& polygons);

}  // namespace viaface
