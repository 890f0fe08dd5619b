// Normals and tangents of a face's nodes: sums over the adjoining triangles, weighted by area. Nodes at one
// place (Face::weld) share a normal, so that no seam shows.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "facemodel/face.hpp"

namespace viaface {

using NodesF = Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>;  // [nodes x 3], mm, head frame

class NodeNormals {
  public:
    explicit NodeNormals(const Face& face);
    void compute(const NodesF& places, NodesF& normals);

    int triangles() const { return int(triangles_.size()); }
    // Takes in the triangle's corners' places if one of them is 1 in `moved`, [nodes].
    void turn(int triangle, const NodesF& places, std::span<const std::uint8_t> moved) {
        const auto& [a, b, c] = triangles_[triangle];
        turned_[triangle] = moved[a] | moved[b] | moved[c];
        if (turned_[triangle] != 0) take_in(triangle, places);
    }
    // Whether an adjoining triangle was taken in when last asked to.
    bool turned(int node) const {
        for (int i = first_adjoining_[node]; i < end_adjoining_[node]; ++i) {
            if (turned_[adjoining_[i]] != 0) return true;
        }
        return false;
    }
    Eigen::RowVector3f of(int node) const;  // unit length; (0, 0, 1) where undefined

  private:
    void take_in(int triangle, const NodesF& places);

    std::vector<Triangle> triangles_;                   // of welded nodes
    std::vector<Eigen::RowVector4f> doubled_areas_;     // along the triangles' normals, mm^2
    std::vector<std::uint8_t> turned_;                  // of each triangle
    std::vector<int> adjoining_;                        // triangles, node after node
    std::vector<int> first_adjoining_, end_adjoining_;  // of each node
};

// [nodes x 4]: unit direction of rising u at rest, and in column 4 the sign that makes
// cross(normal, tangent) * sign the direction of rising v, as glTF has it.
using Tangents = Eigen::Matrix<float, Eigen::Dynamic, 4, Eigen::RowMajor>;
Tangents rest_tangents(const Face& face, const NodesF& normals);

}  // namespace viaface
