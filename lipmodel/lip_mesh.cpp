#include "lipmodel/lip_mesh.hpp"

#include <cmath>
#include <stdexcept>

namespace viaface {
namespace {

constexpr double kRidgeStiffness = 2, kStripStiffness = 0.1;
constexpr double kMouthHeight = -2;    // mm: where closed lips meet
constexpr double kArch = 0.02;         // 1/mm: how the lips follow the teeth round
constexpr double kStripQuadDepth = 6;  // mm

struct Ring {
    double half_width, half_height;  // mm
    double roundness;                // y = half_height (1 - (x / half_width)^2)^roundness
    double forward;                  // z in the middle, mm
};
constexpr std::array<Ring, LipMesh::kRings> kGenericRings = {{{35, 24, 0.5, 7},
                                                              {30, 16, 0.6, 9},
                                                              {26, 10, 0.8, 11.5},
                                                              {25, 6.5, 0.9, 12.5},
                                                              {23.5, 3, 1.0, 10.5},
                                                              {22.5, 0.3, 1.0, 6.5}}};

Eigen::Vector3d generic_place(int ring, int column) {
    const Ring& shape = kGenericRings[ring];
    const int quarter = LipMesh::kColumns / 4;
    const int from_middle = column % LipMesh::kBottom;  // 0 at top or bottom, 8 at a corner
    const double t = static_cast<double>(quarter - std::abs(quarter - from_middle)) / quarter;
    const double side = column < LipMesh::kBottom ? 1 : -1;
    const bool upper = column <= LipMesh::kLeftCorner || column >= LipMesh::kRightCorner;
    const double x = side * t * shape.half_width;
    const double y = (upper ? 1 : -1) * shape.half_height * std::pow(1 - t * t, shape.roundness);
    return {x, kMouthHeight + y, shape.forward - kArch * x * x};
}

Nodes generic_nodes() {
    Nodes nodes(LipMesh::kNodes, 3);
    for (int ring = 0; ring < LipMesh::kRings; ++ring) {
        for (int column = 0; column < LipMesh::kColumns; ++column)
            nodes.row(LipMesh::node(ring, column)) = generic_place(ring, column);
    }
    for (int depth = 1; depth <= LipMesh::kStripDepth; ++depth) {
        for (int across = -1; across <= 1; ++across) {
            nodes.row(LipMesh::strip_node(depth, across)) =
                nodes.row(LipMesh::strip_node(0, across)) -
                depth * kStripQuadDepth * Eigen::RowVector3d::UnitZ();
        }
    }
    return nodes;
}

// Corners counter-clockwise; cut from corner 0, or from corner 1 so that left mirrors right.
void add_quad(LipMesh& mesh, const std::array<int, 4>& q, bool left, LipRegion region, double stiffness) {
    if (left) {
        mesh.triangles.push_back({q[0], q[1], q[2]});
        mesh.triangles.push_back({q[0], q[2], q[3]});
    } else {
        mesh.triangles.push_back({q[0], q[1], q[3]});
        mesh.triangles.push_back({q[1], q[2], q[3]});
    }
    mesh.regions.insert(mesh.regions.end(), 2, region);
    mesh.stiffness.insert(mesh.stiffness.end(), 2, stiffness);
}

void add_band(LipMesh& mesh, int ring) {
    const LipRegion region = ring < LipMesh::kBorderRing ? LipRegion::kSkin : LipRegion::kLips;
    const double stiffness = ring + 1 == LipMesh::kInnerRing ? kRidgeStiffness : 1;
    for (int column = 0; column < LipMesh::kColumns; ++column) {
        add_quad(mesh,
                 {LipMesh::node(ring, column), LipMesh::node(ring + 1, column),
                  LipMesh::node(ring + 1, column + 1), LipMesh::node(ring, column + 1)},
                 column < LipMesh::kBottom, region, stiffness);
    }
}

void add_strip(LipMesh& mesh) {
    for (int depth = 0; depth < LipMesh::kStripDepth; ++depth) {
        for (int across = -1; across < 1; ++across) {
            add_quad(mesh,
                     {LipMesh::strip_node(depth, across), LipMesh::strip_node(depth, across + 1),
                      LipMesh::strip_node(depth + 1, across + 1), LipMesh::strip_node(depth + 1, across)},
                     across == 0, LipRegion::kStrip, kStripStiffness);
        }
    }
}

}  // namespace

Eigen::VectorXd as_column(const Nodes& nodes) {
    return Eigen::Map<const Eigen::VectorXd>(nodes.data(), nodes.size());
}

Nodes as_lip_nodes(const Eigen::VectorXd& column) {
    if (column.size() != LipMesh::kFreedoms) throw std::invalid_argument("as_lip_nodes: not 612 numbers");
    return Eigen::Map<const Nodes>(column.data(), LipMesh::kNodes, 3);
}

LipMesh generic_lip_mesh() {
    LipMesh mesh;
    mesh.nodes = generic_nodes();
    for (int ring = 0; ring + 1 < LipMesh::kRings; ++ring) add_band(mesh, ring);
    add_strip(mesh);
    return mesh;
}

std::array<int, LipMesh::kMarked> marked_nodes() {
    constexpr int kRound = LipMesh::kMarked / 2, kStep = LipMesh::kColumns / kRound;
    std::array<int, LipMesh::kMarked> marked{};
    for (int i = 0; i < kRound; ++i) {
        marked[i] = LipMesh::node(LipMesh::kBorderRing, kStep * i);
        marked[kRound + i] = LipMesh::node(LipMesh::kInnerRing, kStep * i);
    }
    return marked;
}

MarkedPoints marked_of(const Eigen::VectorXd& column) {
    if (column.size() != LipMesh::kFreedoms) throw std::invalid_argument("marked_of: not 612 numbers");
    const auto marked = marked_nodes();
    MarkedPoints points;
    for (int i = 0; i < LipMesh::kMarked; ++i) points.segment<3>(3 * i) = column.segment<3>(3 * marked[i]);
    return points;
}

std::array<int, LipMesh::kStripWidth> held_nodes() {
    return {LipMesh::strip_node(LipMesh::kStripDepth, -1), LipMesh::strip_node(LipMesh::kStripDepth, 0),
            LipMesh::strip_node(LipMesh::kStripDepth, 1)};
}

double largest_extent(const Nodes& nodes) {
    const auto rings = nodes.topRows(LipMesh::kRingNodes);
    return (rings.colwise().maxCoeff() - rings.colwise().minCoeff()).maxCoeff();
}

}  // namespace viaface
