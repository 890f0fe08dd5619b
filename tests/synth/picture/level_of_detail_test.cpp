#include "synth/picture/level_of_detail.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <map>

#include "momo_face.hpp"
#include "simple_faces.hpp"
#include "synth/picture/layers.hpp"
#include "synth/picture/surface_frame.hpp"
#include "synth/picture/view.hpp"

namespace viaface {
namespace {

using testing::momo;

constexpr double kPixel512 = 0.586;  // mm

std::vector<FacePart> thinned(const Face& face, double pixel) {
    WorkPool pool(2);
    return coarser_parts(face, coarseness_for(pixel), pool);
}

std::size_t triangles_in(std::span<const FacePart> parts) {
    std::size_t count = 0;
    for (const FacePart& part : parts) count += part.triangles.size();
    return count;
}

std::vector<int> taken_out(const FacePart& before, const FacePart& after) {
    const std::vector<int> all = nodes_of(before.triangles), left = nodes_of(after.triangles);
    std::vector<int> out;
    std::ranges::set_difference(all, left, std::back_inserter(out));
    return out;
}

// The shares of a triangle's corners at a point of the plane; none are below zero within it.
Eigen::Vector3d shares_at(const Face& face, const Triangle& t, const Eigen::RowVector2f& at) {
    Eigen::Matrix3d corners;
    for (int k = 0; k < 3; ++k) corners.col(k) << face.uvs.row(t[k]).transpose().cast<double>(), 1;
    return corners.inverse() * Eigen::Vector3d(at.x(), at.y(), 1);
}

// How far a node is from what is drawn with its texture coordinates, at the least over the triangles that
// have them: the textures of some parts are laid over each other.
double off_the_drawn(const Face& face, const FacePart& part, int node, const Nodes& places) {
    double least = 1e9;
    for (const Triangle& t : part.triangles) {
        const Eigen::Vector3d shares = shares_at(face, t, face.uvs.row(node));
        if (!(shares.minCoeff() >= -0.02)) continue;
        const Eigen::RowVector3d drawn =
            shares[0] * places.row(t[0]) + shares[1] * places.row(t[1]) + shares[2] * places.row(t[2]);
        least = std::min(least, (drawn - places.row(node)).norm());
    }
    return least;
}

TEST(LevelOfDetail, WhatIsTakenOutIsDrawnWhereItWasAtRestAndInEveryShape) {
    const double pixel = 2 * kPixel512;
    const std::vector<FacePart> parts = thinned(momo(), pixel);
    const double most =
        coarseness_for(pixel).way + 1e-3;  // single precision, shares from rounded coordinates
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const std::vector<int> out = taken_out(momo().parts[i], parts[i]);
        for (std::size_t k = 0; k < out.size(); k += 7) {
            EXPECT_LE(off_the_drawn(momo(), parts[i], out[k], momo().rest), most) << parts[i].name;
            for (const NamedShape& shape : momo().shapes)
                EXPECT_LE(off_the_drawn(momo(), parts[i], out[k], shape.delta), most) << shape.name;
        }
    }
}

TEST(LevelOfDetail, TheSmallerThePictureTheFewerTriangles) {
    const std::size_t all = triangles_in(momo().parts);
    std::size_t before = all;
    for (const double pixel : {kPixel512, 2 * kPixel512, 4 * kPixel512, 8 * kPixel512}) {
        const std::size_t left = triangles_in(thinned(momo(), pixel));
        EXPECT_LT(left, before) << pixel;
        before = left;
    }
    EXPECT_LT(before, all / 2);
}

TEST(LevelOfDetail, InALargePictureHardlyAnythingIsLeftOut) {
    EXPECT_GT(triangles_in(thinned(momo(), kPixel512 / 4)), triangles_in(momo().parts) * 95 / 100);
}

TEST(LevelOfDetail, TheLipsContoursStay) {
    const std::vector<FacePart> parts = thinned(momo(), 8 * kPixel512);
    const auto lips = std::ranges::find(parts, Material::kLips, &FacePart::material);
    ASSERT_NE(lips, parts.end());
    const std::vector<int> left = nodes_of(lips->triangles);
    for (int column = 0; column < LipGrid::kColumns; ++column) {
        EXPECT_TRUE(std::ranges::binary_search(left, momo().lips.node(0, column)));
        EXPECT_TRUE(std::ranges::binary_search(left, momo().lips.node(LipGrid::kRows - 1, column)));
    }
}

// Of an edge that n triangles share n are left, and no triangle is turned over.
TEST(LevelOfDetail, NoHolesAndNothingTurnedOver) {
    const double pixel = 4 * kPixel512;
    NodesF normals;
    NodeNormals(momo()).compute(momo().rest.cast<float>(), normals);
    const auto boundary = [](const FacePart& part) {
        std::map<std::pair<int, int>, int> sides;
        for (const Triangle& t : part.triangles) {
            for (int k = 0; k < 3; ++k) ++sides[std::minmax(t[k], t[(k + 1) % 3])];
        }
        std::erase_if(sides, [](const auto& side) { return side.second == 2; });
        return sides;
    };
    const std::vector<FacePart> parts = thinned(momo(), pixel);
    for (std::size_t i = 0; i < parts.size(); ++i) {
        EXPECT_EQ(boundary(parts[i]), boundary(momo().parts[i])) << parts[i].name;
        const auto& was = momo().parts[i].triangles;
        for (const Triangle& t : parts[i].triangles) {
            if (std::ranges::find(was, t) != was.end()) continue;
            const Eigen::RowVector3d a = momo().rest.row(t[0]), b = momo().rest.row(t[1]),
                                     c = momo().rest.row(t[2]);
            const Eigen::RowVector3d normal = (b - a).cross(c - a);
            for (const int corner : t)
                EXPECT_GT(normal.dot(normals.row(corner).cast<double>()), 0) << parts[i].name;
        }
    }
}

// All but its edges goes.
TEST(LevelOfDetail, OfAFlatSquareTheEdgesStayAndWhatAShapeBends) {
    const auto square = [](double bent) {
        constexpr int kSide = 8;
        Face face;
        Nodes nodes((kSide + 1) * (kSide + 1), 3);
        std::vector<Triangle> triangles;
        for (int y = 0; y <= kSide; ++y) {
            for (int x = 0; x <= kSide; ++x) {
                const int node = y * (kSide + 1) + x;
                nodes.row(node) << x, y, 0;
                if (x == kSide || y == kSide) continue;
                triangles.push_back({node, node + 1, node + kSide + 2});
                triangles.push_back({node, node + kSide + 2, node + kSide + 1});
            }
        }
        testing::add_part(face, Material::kSkin, nodes, triangles);
        face.uvs = nodes.leftCols<2>().cast<float>() / kSide;
        NamedShape shape{"bent", Nodes::Zero(nodes.rows(), 3)};
        shape.delta.col(2) = bent * nodes.rowwise().squaredNorm();
        face.shapes = {shape};
        return face;
    };
    const auto inner_left = [&](double bent) {
        const std::vector<FacePart> parts = thinned(square(bent), 1);
        int inner = 0;
        for (const int node : nodes_of(parts[0].triangles)) {
            const int x = node % 9, y = node / 9;
            inner += x > 0 && x < 8 && y > 0 && y < 8;
        }
        return inner;
    };
    EXPECT_LE(inner_left(0), 2);        // the last has too many neighbours
    EXPECT_EQ(inner_left(0.5), 7 * 7);  // half a millimetre off the middle of neighbours
}

}  // namespace
}  // namespace viaface
