// The mesh of the lip model: 204 nodes, 336 triangles, 612 degrees of freedom. [Basu98, section 2 and A.3]
// Six rings of 32 nodes, from the skin round the mouth to the inner edge of the lips, and at the top a soft
// strip, two quads wide and four deep, that reaches back and is held at its far end. Departure: the paper
// cuts its mesh out of a bought head; ours is made by rule in round figures, the same left and right.
#pragma once

#include <array>
#include <vector>

#include "facemodel/mesh.hpp"

namespace viaface {

enum class LipRegion { kSkin, kLips, kStrip };

struct LipMesh {
    // Column 0 at the middle of the upper lip, then towards the talker's left, down and round.
    static constexpr int kRings = 6, kColumns = 32, kBorderRing = 2, kInnerRing = 5;
    static constexpr int kLeftCorner = kColumns / 4, kBottom = kColumns / 2, kRightCorner = 3 * kColumns / 4;
    static constexpr int kStripWidth = 3, kStripDepth = 4;  // nodes across, quads deep
    static constexpr int kRingNodes = kRings * kColumns;
    static constexpr int kNodes = kRingNodes + kStripWidth * kStripDepth, kTriangles = 336;
    static constexpr int kFreedoms = 3 * kNodes;
    static constexpr int kMarked = 16, kMarkedCoordinates = 3 * kMarked;

    Nodes nodes;                      // [204 x 3], mm, head frame
    std::vector<Triangle> triangles;  // [336], counter-clockwise from outside
    std::vector<LipRegion> regions;   // [336]
    std::vector<double> stiffness;    // [336], elastic modulus E: 1; inner ridge 2; strip 0.1 [Basu98, A.3]

    static constexpr int node(int ring, int column) {
        return ring * kColumns + (column + kColumns) % kColumns;
    }
    // depth 0 is on ring 0; across in -1, 0, 1, rising towards the talker's left
    static constexpr int strip_node(int depth, int across) {
        return depth == 0 ? node(0, across) : kRingNodes + kStripWidth * (depth - 1) + across + 1;
    }
};

// Positions of the marked points, or of the nodes, as one column: x0 y0 z0 x1 ...
using MarkedPoints = Eigen::Matrix<double, LipMesh::kMarkedCoordinates, 1>;  // mm
Eigen::VectorXd as_column(const Nodes& nodes);
Nodes as_lip_nodes(const Eigen::VectorXd& column);

LipMesh generic_lip_mesh();  // lips closed

// The nodes of the sixteen marked points: eight on the border, then eight on the inner edge, each from the
// top towards the talker's left and round. [Basu98, Figure 3]
std::array<int, LipMesh::kMarked> marked_nodes();
MarkedPoints marked_of(const Eigen::VectorXd& column);  // of a column of all nodes [612]

std::array<int, LipMesh::kStripWidth> held_nodes();  // the strip's far end

// Size of the lips and skin (without the strip) along its longest axis, mm. The paper's mesh is 2.83 long.
double largest_extent(const Nodes& nodes);

}  // namespace viaface
