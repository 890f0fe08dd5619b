#include "synth/picture/least_ways.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "momo_face.hpp"
#include "simple_faces.hpp"
#include "synth/picture/portrait.hpp"

namespace viaface {
namespace {

using testing::momo;

TEST(LeastWays, WhatIsDrawnOfAWayRisesWithItAndComesToAllOfIt) {
    const double least = 0.25;
    double before = 0;
    for (double way = 0; way < 4; way += 0.01) {
        const double drawn = way * drawn_share(way * way, least);
        EXPECT_GE(drawn, before);
        EXPECT_LE(drawn - before,
                  2 * 0.01 + 1e-12);  // at most twice as fast: the slope is 1 + (least / way)^2
        EXPECT_LE(way - drawn, way <= least ? way : least * least / way + 1e-12);
        before = drawn;
    }
}

TEST(LeastWays, LipsAndLidsMoveFromATenthOfAPixelOn) {
    const double pixel = 0.5;
    const Eigen::VectorXd least = least_ways(momo(), pixel);
    for (int column = 0; column < LipGrid::kColumns; ++column)
        EXPECT_DOUBLE_EQ(least[momo().lips.node(0, column)], kLeastWay * pixel);
    const auto blink = std::ranges::find(momo().shapes, "eyeBlink_L", &NamedShape::name);
    ASSERT_NE(blink, momo().shapes.end());
    for (Eigen::Index i = 0; i < least.size(); ++i) {
        if (blink->delta.row(i).norm() < 4) continue;
        EXPECT_LT(least[i], 0.2 * pixel) << "node " << i;
    }
}

TEST(LeastWays, FarFromLipsAndEyesNothingIsDrawnAgainForLessThanAPixel) {
    const View view{.width = 256, .height = 256};
    const Eigen::VectorXd least = least_ways(momo(), pixel_size(view));
    const auto all_of = [&](double share) {
        Nodes posed = momo().rest;
        for (Eigen::Index i = 0; i < least.size(); ++i) {
            if (least[i] > 0.9 * kLeastWayFarOff * pixel_size(view)) posed(i, 1) += share * pixel_size(view);
        }
        return posed;
    };
    Portrait portrait(momo(), view);
    const auto rest = testing::bytes(portrait.draw(momo().rest));
    EXPECT_EQ(testing::bytes(portrait.draw(all_of(0.85))), rest);
    EXPECT_NE(testing::bytes(portrait.draw(all_of(3))), rest);
}

}  // namespace
}  // namespace viaface
