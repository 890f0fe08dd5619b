#include "synth/pose/blinks.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace viaface {
namespace {

TEST(Blinks, RepeatForTheSameSeedAndDifferForAnother) {
    BlinkSchedule one(7), same(7), other(8);
    EXPECT_TRUE(std::ranges::equal(one.starts(60), same.starts(60)));
    EXPECT_FALSE(std::ranges::equal(one.starts(60), other.starts(60)));
}

// 20,000 bytes of text at the slowest rate last for hours: signs such as > are spoken as words.
TEST(Blinks, GoOnForAsLongAsSomebodySpeaks) {
    BlinkSchedule blinks(3);
    const auto starts = blinks.starts(48 * 3600);
    EXPECT_LT(starts.front(), 2);
    EXPECT_GT(starts.back(), 48 * 3600 - 6);
    for (std::size_t i = 1; i < starts.size(); ++i) {
        EXPECT_GE(starts[i] - starts[i - 1], 2);
        EXPECT_LE(starts[i] - starts[i - 1], 6 + 1e-9);
    }
}

TEST(Blinks, DoNotDependOnHowTheyAreAskedFor) {
    BlinkSchedule forwards(3), backwards(3);
    std::vector<double> there, back;
    for (int n = 0; n <= 900; ++n) there.push_back(forwards.amount(0.1 * n));
    for (int n = 900; n >= 0; --n) back.push_back(backwards.amount(0.1 * n));
    EXPECT_TRUE(std::equal(there.begin(), there.end(), back.rbegin(), back.rend()));
}

TEST(Blinks, ShutFullyOpenFullyAndNeverJump) {
    BlinkSchedule blinks(1);
    const double start = blinks.starts(20).front();
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
