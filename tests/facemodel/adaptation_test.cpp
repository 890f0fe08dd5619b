#include "facemodel/adaptation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "facemodel/triangulation.hpp"

namespace viaface {
namespace {

// A round head without a face: r = 80 mm less a parabola in height and side.
double bald(double u, double height) { return 80 - (height - 40) * (height - 40) / 400 - u * u / 800; }

struct Scan {
    Nodes nodes;
    std::vector<Triangle> triangles;
};

// The surface as a grid of 2 mm triangles, with a square hole of `hole` mm about (0, 0).
Scan bald_scan(double hole) {
    constexpr int kColumns = 141, kRows = 131;
    Scan scan;
    scan.nodes.resize(kColumns * kRows, 3);
    for (int row = 0; row < kRows; ++row) {
        for (int column = 0; column < kColumns; ++column) {
            const double u = 2 * (column - 70), height = 2 * (row - 50);
            scan.nodes.row(row * kColumns + column) = Cylinder{}.rolled({u, height, bald(u, height)});
            if (row + 1 == kRows || column + 1 == kColumns) continue;
            if (std::max(std::abs(u + 1), std::abs(height + 1)) < hole / 2) continue;
            const int a = row * kColumns + column, b = a + 1, c = a + kColumns + 1, d = a + kColumns;
            scan.triangles.push_back({a, b, c});
            scan.triangles.push_back({a, c, d});
        }
    }
    return scan;
}

RangeMap bald_map(double hole = 0) {
    const Scan scan = bald_scan(hole);
    return RangeMap(RangeFrame{}, scan.nodes, scan.triangles);
}

// Flat triangles of 2 mm lie within e^2 / 8 of curvature (1/75 across, and the parabolas') of the surface:
// 0.02 mm.
constexpr double kGridError = 0.02;

TEST(Cylinder, UnrollingAndRollingGoBack) {
    const Cylinder cylinder;
    const Eigen::Vector3d place(31, -12, 7);
    EXPECT_LT((cylinder.rolled(cylinder.unrolled(place)) - place).norm(), 1e-12);
    EXPECT_GT(cylinder.unrolled({10, 0, 0}).x(), 0);
    EXPECT_EQ(cylinder.unrolled({0, 5, 0}), Eigen::Vector3d(0, 5, 75));
}

TEST(RangeMap, GivesTheSurfaceBetweenSamples) {
    const RangeMap map = bald_map();
    for (double u = -120; u < 120; u += 7.3) {
        for (double height = -80; height < 140; height += 9.1) {
            EXPECT_NEAR(map.range({u, height}).value(), bald(u, height), 2 * kGridError);
        }
    }
    EXPECT_FALSE(map.range({0, 1000}));
}

TEST(RangeMap, AHoleHoldsNothingAndItsBorderTheNearest) {
    const RangeMap map = bald_map(20);
    const Eigen::Vector2d middle = map.frame().cell({0, 0});
    EXPECT_FALSE(map.sample(static_cast<int>(middle.x()), static_cast<int>(middle.y())));
    EXPECT_FALSE(map.range({0, 0}));
    EXPECT_LT(map.samples(), bald_map().samples());
    EXPECT_NEAR(map.range({8.5, 0}).value(), bald(10, 0), 0.5);
}

TEST(Adaptation, NodesLieOnTheSurfaceContoursAndMarkersInTheirPlaces) {
    const GenericMesh mesh = generic_mesh();
    FeaturePoints features = generic_features();
    for (int i = 0; i < kFeaturePoints; ++i) features(i, 1) += features(i, 1) < 15 ? -6 : 0;  // a lower jaw
    place_forehead(features);
    const AdaptedFace face = adapt(mesh, features, bald_map());
    for (Eigen::Index i = 0; i < face.nodes.rows(); ++i) {
        const Eigen::Vector3d flat = Cylinder{}.unrolled(face.nodes.row(i).transpose());
        EXPECT_NEAR(flat.z(), bald(flat.x(), flat.y()), 2 * kGridError);
    }
    for (int i = 0; i < kMarkers; ++i) {
        EXPECT_LT((face.flat.row(mesh.markers[i]) - features.row(kFirstMarker + i)).norm(), 1e-9);
    }
    for (std::size_t c = 0; c < mesh.contours.size(); ++c) {
        const Flat nodes = contour_nodes(feature_contours()[c], features);
        for (Eigen::Index i = 0; i < nodes.rows(); ++i) {
            EXPECT_LT((face.flat.row(mesh.contours[c][i]) - nodes.row(i)).norm(), 1e-9);
        }
    }
    for (const Triangle& t : triangles_of(mesh.polygons)) {
        EXPECT_GT(turn(face.flat.row(t[0]), face.flat.row(t[1]), face.flat.row(t[2])), 0);
    }
}

// Edges are at most 30 mm long and the surface curves with a radius of 60 mm or more: sag under 30^2 / (8 *
// 60).
TEST(Adaptation, TheFittedMeshLiesCloseToTheScan) {
    const GenericMesh mesh = generic_mesh();
    const RangeMap map = bald_map();
    const auto samples = fit_samples(mesh, adapt(mesh, generic_features(), map), map, 8);
    ASSERT_GT(samples.size(), 1000u);
    double sum = 0, largest = 0;
    for (const FitSample& s : samples) sum += s.distance, largest = std::max(largest, s.distance);
    EXPECT_LT(largest, 30.0 * 30 / (8 * 60));
    EXPECT_LT(sum / static_cast<double>(samples.size()), 0.3);
    EXPECT_GT(largest, 0.05);  // a mesh of 844 polygons is not the surface
}

TEST(Adaptation, SaysWhereTheScanHasNoSurface) {
    EXPECT_THROW(adapt(generic_mesh(), generic_features(), bald_map(100)), std::runtime_error);
}

TEST(Adaptation, ShapesHoldTheNodesAndTheirMarkers) {
    const GenericMesh mesh = generic_mesh();
    const AdaptedFace face = adapt(mesh, generic_features(), bald_map());
    const Eigen::VectorXd shape = as_shape(face.nodes);
    EXPECT_EQ(as_nodes(shape), face.nodes);
    const Eigen::VectorXd markers = marker_positions(mesh, shape);
    for (int i = 0; i < kMarkers; ++i) {
        EXPECT_EQ(markers.segment<3>(3 * i), face.nodes.row(mesh.markers[i]).transpose());
    }
}

}  // namespace
}  // namespace viaface
