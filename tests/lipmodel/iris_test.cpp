// Dark discs found where they were painted.
#include "lipmodel/iris.hpp"

#include <gtest/gtest.h>

#include "painted_mouth.hpp"

namespace viaface {
namespace {

// An iris on white between lids: a dark disc, cut above and below, under noise.
test::Painted eye(const Eigen::Vector2d& iris, double radius, int side) {
    test::Noise noise(11);
    test::Painted made{side, side, {}};
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            const Eigen::Vector2d d = Eigen::Vector2d(x, y) - iris;
            const bool lid = std::abs(d.y()) > 0.75 * radius;
            const double dark = 1 / (1 + std::exp(2 * (d.norm() - radius)));
            const double shade = (lid ? 150 : 220 - 170 * dark) + 5 * noise();
            for (int c = 0; c < 3; ++c) made.rgb.push_back(static_cast<std::uint8_t>(shade));
        }
    }
    return made;
}

TEST(Iris, IsFoundWithinATenthOfItsDiameter) {
    for (const double size : {1.0, 3.0}) {
        for (const Eigen::Vector2d& off : {Eigen::Vector2d(0, 0), {2.3, -1.1}, {-3.4, 0.7}}) {
            const Eigen::Vector2d place = size * (Eigen::Vector2d(20, 20) + off);
            const auto picture = eye(place, 4 * size, static_cast<int>(40 * size));
            const int side = static_cast<int>(19 * size);
            const int corner = static_cast<int>(10 * size);
            const Eigen::Vector2d found = iris_in(picture.picture(), {corner, corner, side, side});
            EXPECT_LT((found - place).norm(), 0.1 * 8 * size) << place.transpose();
        }
    }
}

TEST(Iris, StaysInItsPart) {
    const test::Painted flat{20, 20, std::vector<std::uint8_t>(1200, 90)};
    const Eigen::Vector2d found = iris_in(flat.picture(), {5, 6, 9, 8});
    EXPECT_GE(found.x(), 4.5);
    EXPECT_LE(found.y(), 13.5);
    EXPECT_THROW(iris_in(flat.picture(), {15, 6, 9, 8}), std::invalid_argument);
    EXPECT_THROW(iris_in(flat.picture(), {1, 1, 2, 8}), std::invalid_argument);
}

}  // namespace
}  // namespace viaface
