#include "synth/pose/head_sway.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.hpp"

namespace viaface {
namespace {

constexpr double kFrame = 1.0 / 30;  // s

double largest(const HeadTurn& turn) {
    return std::max({std::abs(turn.left), std::abs(turn.up), std::abs(turn.roll)});
}

TEST(HeadSway, StaysWithinItsAmplitudeAndUsesIt) {
    for (const std::uint64_t seed : {0u, 1u, 77u}) {
        const HeadSway sway(4, seed);
        double most = 0;
        for (int n = 0; n < 1800; ++n) most = std::max(most, largest(sway.at(n * kFrame)));
        EXPECT_LE(most, 4) << seed;
        EXPECT_GT(most, 2) << seed;
    }
}

// Waves of at most 0.12 w rad/s each, w = 2 pi: their heights times their frequencies bound the speed.
TEST(HeadSway, IsSlow) {
    const HeadSway sway(4, 5);
    const double fastest = 4 * 2 * 3.1416 * 1.2 * (0.55 * 0.11 + 0.30 * 0.27 + 0.15 * 0.62);  // degrees/s
    for (int n = 0; n < 900; ++n) {
        const HeadTurn a = sway.at(n * kFrame), b = sway.at((n + 1) * kFrame);
        EXPECT_LE(std::abs(b.left - a.left), fastest * kFrame);
    }
}

TEST(HeadSway, ASeedIsAMotion) {
    const HeadSway one(3, 9), again(3, 9), other(3, 10);
    EXPECT_EQ(one.at(1.7).left, again.at(1.7).left);
    EXPECT_NE(one.at(1.7).left, other.at(1.7).left);
    EXPECT_EQ(largest(HeadSway(0, 9).at(1.7)), 0);
}

TEST(HeadSway, WhatIsTooWideOrNoNumberIsRefused) {
    for (const double amplitude : {-0.1, 10.1, std::nan(""), 1e300})
        EXPECT_THROW(HeadSway(amplitude, 1), InputError) << amplitude;
}

// Chin, crown, nose and shoulders of a head.
TEST(Neck, TurnsTheHeadWholeAndLeavesTheShoulders) {
    Face face;
    face.rest.resize(4, 3);
    face.rest << 0, -52, 0, 0, 140, -100, 0, 36, 24, 60, -150, -60;
    Nodes posed = face.rest;
    Neck(face).turn(posed, {8, -5, 3});
    for (int a = 0; a < 3; ++a) {
        EXPECT_GT((posed.row(a) - face.rest.row(a)).norm(), 1);
        for (int b = 0; b < a; ++b) {
            EXPECT_NEAR((posed.row(a) - posed.row(b)).norm(), (face.rest.row(a) - face.rest.row(b)).norm(),
                        1e-9);
        }
    }
    EXPECT_EQ(posed.row(3), face.rest.row(3));
    EXPECT_GT(posed(2, 0), 0);                // to the talker's left
    EXPECT_LT(posed(2, 1), face.rest(2, 1));  // and down
}

}  // namespace
}  // namespace viaface
