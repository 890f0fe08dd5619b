#include "facemodel/triangulation.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <stdexcept>

#include "ensemble.hpp"

namespace viaface {
namespace {

// In-circle determinant of d in the circle through a, b, c, by its definition.
double in_circle(const Eigen::RowVector2d& a, const Eigen::RowVector2d& b, const Eigen::RowVector2d& c,
                 const Eigen::RowVector2d& d) {
    Eigen::Matrix4d m;
    m << a, a.squaredNorm(), 1, b, b.squaredNorm(), 1, c, c.squaredNorm(), 1, d, d.squaredNorm(), 1;
    return m.determinant();
}

TEST(Delaunay, NoPointLiesInsideATrianglesCircle) {
    const Flat points = test::noise(60, 2, 21);
    for (const Triangle& t : delaunay(points)) {
        EXPECT_GT(turn(points.row(t[0]), points.row(t[1]), points.row(t[2])), 0);
        for (Eigen::Index i = 0; i < points.rows(); ++i) {
            // points were moved by 1e-6 of a unit about 1; the determinant is smooth in them
            EXPECT_LT(in_circle(points.row(t[0]), points.row(t[1]), points.row(t[2]), points.row(i)), 1e-4);
        }
    }
}

// Every four neighbours of a grid lie on a circle.
TEST(Delaunay, AGridIsCoveredOnce) {
    Flat grid(81, 2);
    for (int i = 0; i < 81; ++i) grid.row(i) << i % 9, i / 9;
    double area = 0;
    for (const Triangle& t : delaunay(grid)) {
        const double twice = turn(grid.row(t[0]), grid.row(t[1]), grid.row(t[2]));
        EXPECT_GT(twice, -1e-9);  // slivers along the border, where the shift makes it bulge
        area += twice / 2;
    }
    EXPECT_NEAR(area, 64, 1e-9);
}

TEST(Triangulation, EdgesAskedForArePutInAndTheHullStaysCovered) {
    const Flat points = test::noise(60, 2, 22);
    std::vector<Eigen::Vector2d> places;
    for (Eigen::Index i = 0; i < points.rows(); ++i) places.emplace_back(points.row(i));
    Triangulation mesh(places);
    const auto area = [&] {
        double twice = 0;
        for (const Triangle& t : mesh.triangles()) twice += turn(places[t[0]], places[t[1]], places[t[2]]);
        return twice / 2;
    };
    const auto has_edge = [&](int a, int b) {
        return std::ranges::any_of(mesh.triangles(), [&](const Triangle& t) {
            return std::ranges::count(t, a) + std::ranges::count(t, b) == 2;
        });
    };
    const double before = area();
    ASSERT_FALSE(has_edge(0, 1));
    mesh.insert(0, 1);
    EXPECT_TRUE(has_edge(0, 1));
    EXPECT_NEAR(area(), before, 1e-12);
    for (const Triangle& t : mesh.triangles()) EXPECT_GT(turn(places[t[0]], places[t[1]], places[t[2]]), 0);
}

// Each edge is better than the other for ever.
TEST(Triangulation, FlipsWithoutAnEndAreAnError) {
    Triangulation mesh({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
    EXPECT_THROW(mesh.flip_while({}, [](int, int, int, int) { return true; }), std::runtime_error);
}

TEST(Delaunay, RefusesWhatHasNoTriangles) {
    EXPECT_THROW(delaunay(Flat::Zero(2, 2)), std::invalid_argument);
    EXPECT_THROW(delaunay(Flat::Zero(4, 2)), std::invalid_argument);
}

}  // namespace
}  // namespace viaface
