#include "synth/pose/blinks.hpp"

#include <gtest/gtest.h>

namespace viaface {
namespace {

TEST(Blinks, RepeatForTheSameSeedAndDifferForAnother) {
    EXPECT_EQ(BlinkSchedule(60, 7).starts(), BlinkSchedule(60, 7).starts());
    EXPECT_NE(BlinkSchedule(60, 7).starts(), BlinkSchedule(60, 8).starts());
}

TEST(Blinks, ALongerScheduleBeginsLikeAShorterOne) {
    const auto shorter = BlinkSchedule(30, 3).starts(), longer = BlinkSchedule(90, 3).starts();
    ASSERT_GT(longer.size(), shorter.size());
    EXPECT_TRUE(std::equal(shorter.begin(), shorter.end(), longer.begin()));
}

TEST(Blinks, ShutFullyOpenFullyAndNeverJump) {
    const BlinkSchedule blinks(20, 1);
    ASSERT_FALSE(blinks.starts().empty());
    const double start = blinks.starts().front();
    constexpr double kWhole = BlinkSchedule::kShutting + BlinkSchedule::kShut + BlinkSchedule::kOpening;
    EXPECT_EQ(blinks.amount(start - 1e-6), 0);
    EXPECT_EQ(blinks.amount(start + BlinkSchedule::kShutting + BlinkSchedule::kShut / 2), 1);
    EXPECT_EQ(blinks.amount(start + kWhole), 0);
    constexpr double kStep = 0.001, kSteepest = 1.5 / BlinkSchedule::kShutting;  // of 3t^2 - 2t^3
    for (double t = 0; t < 20; t += kStep) {
        EXPECT_LE(std::abs(blinks.amount(t + kStep) - blinks.amount(t)), kSteepest * kStep + 1e-9) << t;
    }
}

}  // namespace
}  // namespace viaface
