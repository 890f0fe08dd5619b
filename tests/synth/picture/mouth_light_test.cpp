#include "synth/picture/mouth_light.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "simple_faces.hpp"

namespace viaface {
namespace {

// Lips whose rows all stand on an ellipse, and one node of tongue behind its middle, facing out.
Face ring_and_node(double half_width, double half_height, double behind) {
    Face face;
    Nodes ring(LipGrid::kRows * LipGrid::kColumns, 3);
    for (int row = 0; row < LipGrid::kRows; ++row) {
        for (int column = 0; column < LipGrid::kColumns; ++column) {
            const double angle = 2 * std::numbers::pi * column / LipGrid::kColumns;
            ring.row(row * LipGrid::kColumns + column) << half_width * std::sin(angle),
                half_height * std::cos(angle), 0;
        }
    }
    testing::add_part(face, Material::kLips, ring, {});
    Nodes node(1, 3);
    node << 0, 0, -behind;
    testing::add_part(face, Material::kTongue, node, {});
    return face;
}

float light_of_node(const Face& face) {
    NodesF normals = NodesF::Zero(face.rest.rows(), 3);
    normals.col(2).setOnes();
    std::vector<float> light(face.rest.rows(), 1.0f);
    WorkPool pool(1);
    const int tongue[] = {int(face.rest.rows()) - 1};
    MouthLight(face).compute(face.rest.cast<float>(), normals, tongue, pool, light);
    return light.back();
}

// A disc of radius r, seen squarely from d behind it: |F| = r^2 / (r^2 + d^2). The polygon of 20 corners is a
// little smaller than the disc.
TEST(MouthLight, DiscHasItsFormFactor) {
    for (const double behind : {1.0, 10.0, 30.0}) {
        const double r = 15, expected = r * r / (r * r + behind * behind);
        const double light = light_of_node(ring_and_node(r, r, behind));
        EXPECT_NEAR(light * light, expected, 0.03 * expected + 2.0 / 255);
        EXPECT_LT(light * light, expected + 2.0 / 255);
    }
}

TEST(MouthLight, WiderOpenIsBrighter) {
    double last = -1;
    for (const double half_height : {0.2, 1.0, 3.0, 8.0, 20.0}) {
        const double light = light_of_node(ring_and_node(20, half_height, 25));
        EXPECT_GT(light, last);
        last = light;
    }
}

TEST(MouthLight, InFrontOfTheLipsIsFullLight) { EXPECT_EQ(light_of_node(ring_and_node(20, 10, -5)), 1); }

TEST(MouthLight, LipsDarkenWhereTheyTouch) {
    const auto darkest = [](double half_height) {
        const Face face = ring_and_node(20, half_height, 25);
        std::vector<float> light(face.rest.rows(), 1.0f);
        WorkPool pool(1);
        MouthLight(face).compute(face.rest.cast<float>(), NodesF::Zero(face.rest.rows(), 3), {}, pool, light);
        return light[face.lips.node(LipGrid::kRows - 1, 0)];
    };
    EXPECT_LT(darkest(0.01), 0.3);
    EXPECT_GT(darkest(10), 0.99);
}

}  // namespace
}  // namespace viaface
