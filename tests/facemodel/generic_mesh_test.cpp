#include "facemodel/generic_mesh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <set>

#include "facemodel/triangulation.hpp"

namespace viaface {
namespace {

using Edge = std::array<int, 2>;

std::vector<int> corners(const Polygon& p) {
    return p[3] < 0 ? std::vector<int>{p[0], p[1], p[2]} : std::vector<int>{p[0], p[1], p[2], p[3]};
}

// Directed edges and how often each occurs.
std::map<Edge, int> edges_of(const GenericMesh& mesh) {
    std::map<Edge, int> edges;
    for (const Polygon& p : mesh.polygons) {
        const auto c = corners(p);
        for (std::size_t k = 0; k < c.size(); ++k) ++edges[{c[k], c[(k + 1) % c.size()]}];
    }
    return edges;
}

std::set<Edge> border_of(const GenericMesh& mesh) {
    const auto edges = edges_of(mesh);
    std::set<Edge> border;
    for (const auto& [edge, count] : edges) {
        if (!edges.contains({edge[1], edge[0]}))
            border.insert({std::min(edge[0], edge[1]), std::max(edge[0], edge[1])});
    }
    return border;
}

TEST(GenericMesh, HasTheReportsCounts) {
    const GenericMesh mesh = generic_mesh();
    EXPECT_EQ(mesh.flat.rows(), 576);
    EXPECT_EQ(mesh.polygons.size(), 844u);
    const auto quads = std::ranges::count_if(mesh.polygons, [](const Polygon& p) { return p[3] >= 0; });
    EXPECT_GT(quads, 0);
    EXPECT_LT(quads, 844);
}

TEST(GenericMesh, IsAManifoldWithThreeHolesThatUsesEveryNode) {
    const GenericMesh mesh = generic_mesh();
    std::set<int> used;
    for (const Polygon& p : mesh.polygons) {
        for (const int i : corners(p)) used.insert(i);
    }
    EXPECT_EQ(used.size(), 576u);
    const auto edges = edges_of(mesh);
    int undirected = 0;
    for (const auto& [edge, count] : edges) {
        EXPECT_EQ(count, 1);
        undirected += edge[0] < edge[1] || !edges.contains({edge[1], edge[0]});
    }
    EXPECT_EQ(576 - undirected + 844, 1 - 3);  // Euler: one piece, a disk with mouth and eyes cut out
}

TEST(GenericMesh, ItsBordersAreTheFeatureContours) {
    const GenericMesh mesh = generic_mesh();
    std::set<Edge> expected;
    for (int c = 0; c < kBoundaries; ++c) {
        const auto& nodes = mesh.contours[c];
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            const int a = nodes[i], b = nodes[(i + 1) % nodes.size()];
            expected.insert({std::min(a, b), std::max(a, b)});
        }
    }
    EXPECT_EQ(border_of(mesh), expected);
    EXPECT_EQ(mesh.contours[kMouthContour].size(), 40u);
}

TEST(GenericMesh, NoPolygonIsFoldedOrConcave) {
    const GenericMesh mesh = generic_mesh();
    for (const Polygon& p : mesh.polygons) {
        const auto c = corners(p);
        for (std::size_t k = 0; k < c.size(); ++k) {
            EXPECT_GT(turn(mesh.flat.row(c[k]), mesh.flat.row(c[(k + 1) % c.size()]),
                           mesh.flat.row(c[(k + 2) % c.size()])),
                      0);
        }
    }
    EXPECT_EQ(triangles_of(mesh.polygons).size(),
              844u + std::ranges::count_if(mesh.polygons, [](const Polygon& p) { return p[3] >= 0; }));
}

TEST(GenericMesh, LeftMirrorsRight) {
    const GenericMesh mesh = generic_mesh();
    for (Eigen::Index i = 0; i < mesh.flat.rows(); ++i) {
        const Eigen::RowVector2d mirrored(-mesh.flat(i, 0), mesh.flat(i, 1));
        EXPECT_LT((mesh.flat.rowwise() - mirrored).rowwise().norm().minCoeff(), 1e-9) << i;
    }
}

TEST(GenericMesh, MarkersAreDifferentNodesInTheirPlaces) {
    const GenericMesh mesh = generic_mesh();
    const FeaturePoints features = generic_features();
    EXPECT_EQ(std::set<int>(mesh.markers.begin(), mesh.markers.end()).size(), 18u);
    for (int i = 0; i < kMarkers; ++i) {
        EXPECT_LT((mesh.flat.row(mesh.markers[i]) - features.row(kFirstMarker + i)).norm(), 1e-6);
    }
}

// "Nodes are most heavily concentrated periorally, along the nose, and especially around the eyes".
TEST(GenericMesh, NodesAreCloseTogetherAtTheFeaturesAndSparseElsewhere) {
    const GenericMesh mesh = generic_mesh();
    const auto count_within = [&](double u, double height, double radius) {
        return ((mesh.flat.rowwise() - Eigen::RowVector2d(u, height)).rowwise().norm().array() < radius)
            .count();
    };
    const auto forehead = count_within(0, 120, 18), cheek = count_within(75, 30, 18);
    EXPECT_GT(count_within(37, 70, 18), 3 * forehead);
    EXPECT_GT(count_within(0, 30, 18), 3 * forehead);
    EXPECT_GT(count_within(26, 0, 18), 3 * cheek);
}

TEST(GenericMesh, IsTheSameEveryTime) {
    const GenericMesh once = generic_mesh(), again = generic_mesh();
    EXPECT_EQ(once.flat, again.flat);
    EXPECT_EQ(once.polygons, again.polygons);
}

}  // namespace
}  // namespace viaface
