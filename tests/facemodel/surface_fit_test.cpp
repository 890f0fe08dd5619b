#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "facemodel/deformation_transfer.hpp"
#include "facemodel/smooth_fit.hpp"

namespace viaface {
namespace {

using Eigen::Vector3d;

// A square of side 40 in cells of 2 mm, lifted by `height`.
template <class Height>
TriangleMesh sheet(const Height& height, int side = 21) {
    TriangleMesh mesh{Nodes(side * side, 3), {}};
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            const double px = 2.0 * x - side + 1, py = 2.0 * y - side + 1;
            mesh.nodes.row(y * side + x) << px, py, height(px, py);
            if (x + 1 == side || y + 1 == side) continue;
            const int a = y * side + x;
            mesh.triangles.push_back({a, a + 1, a + side + 1});
            mesh.triangles.push_back({a, a + side + 1, a + side});
        }
    }
    return mesh;
}

double flat(double, double) { return 0; }
double bump(double x, double y) { return 6 * std::exp(-(x * x + y * y) / 120); }

TEST(NearestSurface, IsTheNearestOfAllTriangles) {
    const TriangleMesh mesh = sheet(bump);
    const NearestSurface surface(mesh.nodes, mesh.triangles);
    for (int k = 0; k < 200; ++k) {
        const Vector3d place(25 * std::sin(1.3 * k), 25 * std::cos(2.1 * k), 10 * std::sin(0.7 * k));
        double least = 1e9;
        for (const Triangle& t : mesh.triangles) {
            const Vector3d a = mesh.nodes.row(t[0]), b = mesh.nodes.row(t[1]), c = mesh.nodes.row(t[2]);
            const Vector3d s = nearest_shares(place, a, b, c);
            EXPECT_GE(s.minCoeff(), -1e-12);
            EXPECT_NEAR(s.sum(), 1, 1e-12);
            least = std::min(least, (s[0] * a + s[1] * b + s[2] * c - place).norm());
        }
        const SurfacePlace found = surface(place);
        EXPECT_NEAR(found.distance, least, 1e-9);
        EXPECT_NEAR((found.place - place).norm(), least, 1e-9);
        EXPECT_EQ(surface(place, least / 2).triangle, -1);
    }
    EXPECT_TRUE(surface.on_border(surface(Vector3d(30, 0, 0))));
    EXPECT_FALSE(surface.on_border(surface(Vector3d(3.3, 1.1, 8))));
}

const FitStage kStages[] = {{20, 15, 3}, {8, 8, 3}, {3, 5, 3}, {1, 3, 3}};

TEST(SmoothFit, LiesOnTheScan) {
    const TriangleMesh start = sheet(flat, 19), scan = sheet(bump);
    const NearestSurface surface(scan.nodes, scan.triangles);
    const SmoothFit fit = fit_smoothly(start.nodes, start.triangles, surface,
                                       Eigen::VectorXd::Ones(start.nodes.rows()), {}, kStages);
    for (Eigen::Index i = 0; i < fit.nodes.rows(); ++i)
        EXPECT_LT(surface(fit.nodes.row(i)).distance, 0.15) << i;
}

TEST(SmoothFit, GoesOnSmoothlyWhereThereIsNoScanAndKeepsPins) {
    const auto lifted = [](double, double) { return 3.0; };
    const TriangleMesh start = sheet(flat, 19);
    TriangleMesh scan = sheet(lifted);
    std::erase_if(scan.triangles,
                  [&](const Triangle& t) { return scan.nodes.row(t[0]).head<2>().norm() < 8; });
    const NearestSurface surface(scan.nodes, scan.triangles);
    const Eigen::VectorXd trust = Eigen::VectorXd::Ones(start.nodes.rows());
    const SmoothFit fit = fit_smoothly(start.nodes, start.triangles, surface, trust, {}, kStages);
    const int middle = 9 * 19 + 9;
    EXPECT_FALSE(fit.covered[middle]);
    EXPECT_NEAR(fit.nodes(middle, 2), 3, 0.1);
    const SmoothFit pinned =
        fit_smoothly(start.nodes, start.triangles, surface, trust, {{middle, {0, 0, 5}, 1e6}}, kStages);
    EXPECT_NEAR(pinned.nodes(middle, 2), 5, 0.05);
}

TEST(DeformationTransfer, OfAMeshToItselfIsThePose) {
    const TriangleMesh mesh = sheet(bump);
    std::vector<bool> still(static_cast<std::size_t>(mesh.nodes.rows()));
    for (int x = 0; x < 21; ++x) still[static_cast<std::size_t>(x)] = true;
    Nodes pose = mesh.nodes;
    for (Eigen::Index i = 0; i < pose.rows(); ++i) pose(i, 2) += 0.002 * std::pow(pose(i, 1) + 20, 2);
    const DeformationTransfer transfer(mesh.nodes, mesh.nodes, mesh.triangles, still);
    EXPECT_LT((transfer(pose) - pose).cwiseAbs().maxCoeff(), 1e-3);
    EXPECT_LT((transfer(mesh.nodes) - mesh.nodes).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(DeformationTransfer, ScalesWaysWithTheTarget) {
    const TriangleMesh mesh = sheet(flat);
    std::vector<bool> still(static_cast<std::size_t>(mesh.nodes.rows()));
    for (int x = 0; x < 21; ++x) still[static_cast<std::size_t>(x)] = true;
    Nodes pose = mesh.nodes;  // sheared: the same map for every triangle
    pose.col(0) += 0.3 * (pose.col(1).array() + 20).matrix();
    const Nodes target = 1.5 * mesh.nodes;
    const Nodes moved = DeformationTransfer(mesh.nodes, target, mesh.triangles, still)(pose) - target;
    EXPECT_LT((moved - 1.5 * (pose - mesh.nodes)).cwiseAbs().maxCoeff(), 1e-3);
}

}  // namespace
}  // namespace viaface
