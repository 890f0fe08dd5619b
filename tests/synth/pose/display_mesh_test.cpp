#include <Eigen/Geometry>
#include <map>

#include "talker.hpp"

namespace viaface {
namespace {

double nearest_scan_node(const Nodes& scan, const Eigen::RowVector3d& place) {
    return (scan.rowwise() - place).rowwise().norm().minCoeff();
}

TEST(DisplayMesh, HasFewerThanNineThousandNodesOfItsOwn) {
    SKIP_WITHOUT_SCANS();
    const auto& talker = test_talker();
    EXPECT_GT(talker.face.rest.rows(), 4500);
    EXPECT_LT(talker.face.rest.rows(), 9000);
    EXPECT_EQ(part_of(talker.face, "lips").nodes, 600);
    const Nodes scan = talker.head.pose(posture("closed_relaxed").weights);
    int near = 0;
    for (Eigen::Index i = 0; i < talker.face.rest.rows(); ++i) {
        near += nearest_scan_node(scan, talker.face.rest.row(i)) < 0.01;
    }
    EXPECT_LT(near, 0.01 * static_cast<double>(talker.face.rest.rows()));
}

// Every edge of the skin has one triangle on each side, or bounds the lids, the lips or the shared ring; all
// triangles look the same way.
TEST(DisplayMesh, SkinIsAnOrientedSurface) {
    SKIP_WITHOUT_SCANS();
    const auto& anchors = test_talker().source.anchors();
    std::map<std::pair<int, int>, int> edges;
    for (const Triangle& t : anchors.front_triangles) {
        for (std::size_t k = 0; k < 3; ++k) ++edges[{t[k], t[(k + 1) % 3]}];
    }
    int open = 0;
    for (const auto& [edge, count] : edges) {
        EXPECT_EQ(count, 1);
        open += !edges.contains({edge.second, edge.first});
    }
    EXPECT_EQ(open, anchors.ring + 2 * anchors.lid_nodes + LipGrid::kColumns);
}

TEST(DisplayMesh, NoTriangleOfTheSkinIsFoldedAgainstTheScan) {
    SKIP_WITHOUT_SCANS();
    const auto& talker = test_talker();
    const auto& anchors = talker.source.anchors();
    const Nodes& scan = talker.head.neutral().nodes;
    const Nodes nodes = nodes_at(anchors.front, scan);
    const auto scan_normal = [&](const Anchor& a) -> Eigen::Vector3d {
        const Eigen::Vector3d p = scan.row(a.nodes[0]), q = scan.row(a.nodes[1]), r = scan.row(a.nodes[2]);
        return (q - p).cross(r - p);
    };
    int folded = 0;
    for (const Triangle& t : anchors.front_triangles) {
        const Eigen::Vector3d a = nodes.row(t[0]), b = nodes.row(t[1]), c = nodes.row(t[2]);
        const Eigen::Vector3d normal = (b - a).cross(c - a).normalized();
        double best = -1;
        for (const int node : t) {
            const Eigen::Vector3d of_scan = scan_normal(anchors.front[static_cast<std::size_t>(node)]);
            if (of_scan.norm() > 1e-9) best = std::max(best, normal.dot(of_scan.normalized()));
            if (of_scan.norm() <= 1e-9) best = 1;  // an anchor on an edge of the scan says nothing
        }
        folded += best < 0;
    }
    // Deep in the nostrils and behind the ears the scan folds more tightly than the spacing.
    EXPECT_LT(folded, 0.005 * static_cast<double>(anchors.front_triangles.size()));
}

TEST(DisplayMesh, IsTheSameEveryTime) {
    SKIP_WITHOUT_SCANS();
    const auto& talker = test_talker();
    const DisplayAnchors again = remesh_head(talker.head);
    EXPECT_EQ(again.front_triangles, talker.source.anchors().front_triangles);
    EXPECT_EQ(again.back_triangles, talker.source.anchors().back_triangles);
}

}  // namespace
}  // namespace viaface
