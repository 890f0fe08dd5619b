// A face cut along a level of a field over its nodes at rest: triangles across the level are cut in two
// there, at nodes of their own that ride on the edges they stand on. What is left ends in a clean line that
// moves with the face.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "facemodel/face.hpp"

namespace viaface {

struct CutNode {
    int from, to;  // nodes of the face
    double share;  // of the way between them, 0 to 1
};

struct CutFace {
    Face face;                   // the nodes of the face it was cut from, then those of the cut
    std::vector<CutNode> nodes;  // of the cut
};

// Places of the cut's nodes after those of the whole face. [nodes x 3], mm
Nodes with_cut(const Nodes& whole, const std::vector<CutNode>& nodes);

// Keeps the skin where the field is not negative, and of the other materials those that `keeps` names.
// field: [nodes of the face].
CutFace cut_skin(Face face, const Eigen::VectorXd& field, bool (*keeps)(Material));

}  // namespace viaface
