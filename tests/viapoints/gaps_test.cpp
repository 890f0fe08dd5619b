#include "viapoints/gaps.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/error.hpp"

namespace viaface {
namespace {

// Two points that swing at 2 Hz by 5 mm, at 100 Hz.
PointRecording swinging() {
    PointRecording r;
    r.labels = {"a", "b"};
    r.positions.resize(200, 6);
    for (int i = 0; i < 200; ++i) {
        r.time_s.push_back(i / 100.0);
        for (int k = 0; k < 6; ++k) r.positions(i, k) = 5 * std::sin(4 * M_PI * i / 100.0 + k);
    }
    return r;
}

PointRecording with_gap(int point, int first, int behind) {
    PointRecording r = swinging();
    r.positions.block(first, 3 * point, behind - first, 3)
        .setConstant(std::numeric_limits<double>::quiet_NaN());
    return r;
}

TEST(Gaps, AreBridgedAlongTheMotionAndReported) {
    PointRecording r = with_gap(1, 60, 70);
    const auto gaps = bridge_gaps(r, 0.2, LongGaps::kRefuse);
    ASSERT_EQ(gaps.size(), 1u);
    EXPECT_EQ(gaps[0].label, "b");
    EXPECT_NEAR(gaps[0].length_s(), 0.11, 1e-12);
    EXPECT_TRUE(gaps[0].bridged);
    // A spline of fifth degree through a sine: far below a straight line's 5 mm (1 - cos(0.055 * 4 pi)) = 1.2
    // mm.
    EXPECT_LT((r.positions - swinging().positions).cwiseAbs().maxCoeff(), 0.1);
    EXPECT_EQ(r.positions.leftCols(3), swinging().positions.leftCols(3));
}

TEST(Gaps, LongerOnesAreRefusedByNameOrLeft) {
    PointRecording r = with_gap(0, 60, 90);
    try {
        bridge_gaps(r, 0.2, LongGaps::kRefuse);
        FAIL();
    } catch (const InputError& error) {
        EXPECT_EQ(error.value(), "a missing from 0.590000 to 0.900000 s");
    }
    const auto gaps = bridge_gaps(r, 0.2, LongGaps::kLeave);
    ASSERT_EQ(gaps.size(), 1u);
    EXPECT_FALSE(gaps[0].bridged);
    EXPECT_TRUE(r.positions.block(60, 0, 30, 3).array().isNaN().all());
}

TEST(Gaps, AtTheEndsThePlaceIsHeld) {
    PointRecording r = with_gap(0, 190, 200);
    bridge_gaps(r, 0.2, LongGaps::kRefuse);
    EXPECT_EQ(r.positions.row(199).head(3), r.positions.row(189).head(3));
}

TEST(Gaps, APointNeverMeasuredHasNone) {
    PointRecording r = with_gap(0, 0, 200);
    EXPECT_TRUE(bridge_gaps(r, 0.2, LongGaps::kRefuse).empty());
    EXPECT_TRUE(std::isnan(r.positions(0, 0)));
}

}  // namespace
}  // namespace viaface
