#include "lipmodel/lip_mesh.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <set>

namespace viaface {
namespace {

TEST(LipMesh, CountsAreThoseOfThePaper) {
    const LipMesh mesh = generic_lip_mesh();
    EXPECT_EQ(mesh.nodes.rows(), 204);
    EXPECT_EQ(mesh.triangles.size(), 336u);
    EXPECT_EQ(LipMesh::kFreedoms, 612);
    EXPECT_EQ(mesh.regions.size(), 336u);
    EXPECT_EQ(std::ranges::count(mesh.regions, LipRegion::kStrip), 16);
    EXPECT_EQ(std::ranges::count(mesh.stiffness, 2.0), 64);
    std::set<int> used;
    for (const Triangle& t : mesh.triangles) used.insert(t.begin(), t.end());
    EXPECT_EQ(used.size(), 204u);
}

TEST(LipMesh, IsOneOrientedSheetWithOneHole) {
    const LipMesh mesh = generic_lip_mesh();
    std::map<std::pair<int, int>, int> directed;
    for (const Triangle& t : mesh.triangles) {
        for (int i = 0; i < 3; ++i) EXPECT_EQ(directed[std::pair(t[i], t[(i + 1) % 3])]++, 0);
    }
    std::set<std::pair<int, int>> edges;
    for (const auto& [edge, count] : directed) edges.insert(std::minmax(edge.first, edge.second));
    // Euler: nodes - edges + faces = 0 for a ring
    EXPECT_EQ(204 - static_cast<int>(edges.size()) + 336, 0);
}

TEST(LipMesh, FacesForwardAndMirrorsItself) {
    const LipMesh mesh = generic_lip_mesh();
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const auto corner = [&](int c) { return Eigen::Vector3d(mesh.nodes.row(mesh.triangles[i][c])); };
        const Eigen::Vector3d normal = (corner(1) - corner(0)).cross(corner(2) - corner(0)).normalized();
        EXPECT_TRUE(mesh.regions[i] != LipRegion::kSkin || normal.z() > 0) << i;
        EXPECT_TRUE(mesh.regions[i] != LipRegion::kStrip || normal.y() > 0.9) << i;
    }
    const auto same_faces = [&](const auto& map_node) {
        std::set<std::set<int>> original, mapped;
        for (const Triangle& t : mesh.triangles) {
            original.insert({t[0], t[1], t[2]});
            mapped.insert({map_node(t[0]), map_node(t[1]), map_node(t[2])});
        }
        return original == mapped;
    };
    const auto mirror = [&](int node) {
        const Eigen::RowVector3d place = mesh.nodes.row(node).cwiseProduct(Eigen::RowVector3d(-1, 1, 1));
        for (int i = 0; i < mesh.nodes.rows(); ++i) {
            if ((mesh.nodes.row(i) - place).norm() < 1e-9) return i;
        }
        return -1;
    };
    EXPECT_TRUE(same_faces(mirror));
}

TEST(LipMesh, MarkedPointsLieOnTheBorderAndTheInnerEdge) {
    const LipMesh mesh = generic_lip_mesh();
    const MarkedPoints points = marked_of(as_column(mesh.nodes));
    const auto point = [&](int i) { return Eigen::Vector3d(points.segment<3>(3 * i)); };
    for (const int first : {0, 8}) {
        EXPECT_NEAR(point(first).x(), 0, 1e-12);
        EXPECT_GT(point(first).y(), point(first + 4).y());
        EXPECT_GT(point(first + 2).x(), point(first + 1).x());  // the talker's left is +x
        EXPECT_LT(point(first + 6).x(), point(first + 5).x());
    }
    EXPECT_GT(point(0).y(), point(8).y());
    EXPECT_LT(point(4).y(), point(12).y());
    EXPECT_EQ(as_lip_nodes(as_column(mesh.nodes)), mesh.nodes);
}

}  // namespace
}  // namespace viaface
