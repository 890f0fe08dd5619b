#include "lipmodel/class_maps.hpp"

#include <gtest/gtest.h>

#include "painted_mouth.hpp"

namespace viaface {
namespace {

TEST(HammingKernel, IsNormalisedSymmetricAndTheWindow) {
    for (const int size : {1, 3, 7, 21}) {
        const auto kernel = hamming_kernel(size);
        double sum = 0;
        for (int i = 0; i < size; ++i) {
            EXPECT_DOUBLE_EQ(kernel[i], kernel[size - 1 - i]);
            sum += kernel[i];
        }
        EXPECT_NEAR(sum, 1, 1e-12);
    }
    const auto seven = hamming_kernel(7);
    EXPECT_NEAR(seven[0] / seven[3], 0.08, 1e-12);
    EXPECT_NEAR(seven[1] / seven[3], 0.31, 1e-12);
    EXPECT_THROW(hamming_kernel(4), std::invalid_argument);
    EXPECT_EQ(hamming_size(80), 7);
    EXPECT_EQ(hamming_size(160), 15);
    EXPECT_EQ(hamming_size(8), 3);
}

struct Maps {
    test::Painting how{.noise = 10};
    test::Painted painted =
        test::paint(how, generic_lip_mesh().nodes, {.turn = {0, 0, 0}, .shift = {0, 0, 1000}});
    ColourClasses classes = test::picked_classes(10);
    ClassMaps maps = class_maps(painted.picture(), {40, 30, 120, 100}, classes, 5);
};

TEST(ClassMaps, AreLogarithmsOfFits) {
    const Maps m;
    for (const LogMap* map : {&m.maps.lips, &m.maps.skin, &m.maps.opening}) {
        EXPECT_EQ(map->values.size(), 120u * 100);
        for (const float value : map->values) {
            ASSERT_LE(value, 1e-6);
            ASSERT_GE(value, std::log(0.01) - 1e-6);
        }
    }
    EXPECT_GT(m.maps.skin.at({60, 40}).value, -0.2);
    EXPECT_LT(m.maps.lips.at({60, 40}).value, -2);
    EXPECT_LT(m.maps.independence, 0.15);  // five by five values are worth some ten
}

TEST(ClassMaps, SlopesAreThoseOfTheValues) {
    const Maps m;
    test::Noise noise(31);
    for (int i = 0; i < 100; ++i) {
        const Eigen::Vector2d place(100.3 + std::floor(30 * noise()), 80.6 + std::floor(20 * noise()));
        const MapSample here = m.maps.lips.at(place);
        for (int axis = 0; axis < 2; ++axis) {
            const Eigen::Vector2d step = 0.1 * Eigen::Vector2d::Unit(axis);  // stays within the cell
            EXPECT_NEAR((m.maps.lips.at(place + step).value - m.maps.lips.at(place - step).value) / 0.2,
                        here.slope[axis], 1e-9);
        }
    }
}

TEST(ClassMaps, GoOnOutwards) {
    const Maps m;
    const MapSample edge = m.maps.skin.at({40, 50}), out = m.maps.skin.at({-500, 50});
    EXPECT_EQ(edge.value, out.value);
    EXPECT_EQ(out.slope.x(), 0);
}

TEST(ClassMaps, RefuseABoxOutsideThePicture) {
    const Maps m;
    for (const PictureBox& box :
         {PictureBox{-1, 0, 10, 10}, {0, 0, 0, 5}, {150, 0, 60, 10}, {0, 100, 10, 61}})
        EXPECT_THROW(class_maps(m.painted.picture(), box, m.classes, 5), std::invalid_argument);
    EXPECT_EQ(class_maps(m.painted.picture(), {10, 10, 1, 1}, m.classes, 3).lips.at({10, 10}).slope.norm(),
              0);
}

}  // namespace
}  // namespace viaface
