#include "synth/training/gestures.hpp"

#include <gtest/gtest.h>

#include "tests/synth/training/spoken.hpp"

namespace viaface {
namespace {

using testing::spoken;

constexpr const char* kSentence =
    "pau:150 p:90 l:60 iy1:110 z:80 b:70 r:60 ih1:90 ng:60 m:70 iy0:80 f:90 ay1:160 v:60 b:80 aa1:170 k:80 "
    "s:90 "
    "ih0:60 z:80 w:70 ih0:60 dh:50 uw1:130 sh:100 ao1:150 t:70 pau:200";

TEST(PhoneGestures, EveryPhoneAimsInEveryChannel) {
    for (std::size_t phone = 0; phone < phone_table().size(); ++phone) {
        const auto parts = gestures_of(static_cast<PhoneId>(phone));
        ASSERT_TRUE(parts.size() == 1 || parts.size() == 2) << phone_table()[phone].name;
        for (const Gestures& gestures : parts) {
            for (const Gesture& g : gestures) {
                EXPECT_TRUE(std::abs(g.target) < 15) << phone_table()[phone].name;
                EXPECT_GT(g.dominance, 0) << phone_table()[phone].name;
                EXPECT_GT(g.reach_ms, 0) << phone_table()[phone].name;
            }
        }
    }
}

TEST(PhoneGestures, OnlyVowelsGlide) {
    for (std::size_t phone = 0; phone < phone_table().size(); ++phone) {
        const bool glides = gestures_of(static_cast<PhoneId>(phone)).size() == 2;
        EXPECT_TRUE(!glides || phone_table()[phone].vowel) << phone_table()[phone].name;
    }
}

TEST(Gesture, CoversThePhonesAtItsRate) {
    const PhoneSequence phones = spoken(kSentence);
    const ChannelMotion motion = gesture(phones);
    ASSERT_EQ(motion.channels.rows(), static_cast<Eigen::Index>(motion.time_s.size()));
    EXPECT_EQ(motion.time_s.front(), 0);
    EXPECT_GE(motion.time_s.back(), phones.end_s(phones.phones.size() - 1));
    EXPECT_NEAR(motion.time_s[40], 40 / kGestureRate, 1e-12);
    EXPECT_THROW(gesture(PhoneSequence{}), std::invalid_argument);
}

TEST(Gesture, RestsAtBothEnds) {
    const ChannelMotion motion = gesture(spoken(kSentence));
    const auto resting = resting_channels();
    const Eigen::RowVectorXd rest = Eigen::Map<const Eigen::RowVectorXd>(resting.data(), kChannels);
    EXPECT_LT((motion.channels.topRows(3).rowwise() - rest).cwiseAbs().maxCoeff(), 0.05);
    EXPECT_LT((motion.channels.bottomRows(3).rowwise() - rest).cwiseAbs().maxCoeff(), 0.05);
}

// A minimum-jerk stroke of 12 mm in 80 ms peaks at a jerk of 60 * 12 / 0.08^3 mm/s^3; a jump of 1 mm in one
// sample would show a third difference of 1 mm * rate^3, seven times that.
TEST(Gesture, IsSmooth) {
    const ChannelMotion motion = gesture(spoken(kSentence));
    const Eigen::Index n = motion.channels.rows();
    const auto& x = motion.channels;
    const RowMatrix third =
        x.bottomRows(n - 3) - 3 * x.middleRows(2, n - 3) + 3 * x.middleRows(1, n - 3) - x.topRows(n - 3);
    EXPECT_LT(third.cwiseAbs().maxCoeff() * std::pow(kGestureRate, 3), 60 * 12 / std::pow(0.08, 3));
}

TEST(Gesture, StaysBetweenItsTargets) {
    const ChannelMotion motion = gesture(spoken(kSentence));
    for (int channel = 0; channel < kChannels; ++channel) {
        double least = 0, most = 0;
        for (std::size_t phone = 0; phone < phone_table().size(); ++phone) {
            for (const Gestures& g : gestures_of(static_cast<PhoneId>(phone))) {
                least = std::min(least, g[static_cast<std::size_t>(channel)].target);
                most = std::max(most, g[static_cast<std::size_t>(channel)].target);
            }
        }
        const double slack = 0.1 * (most - least);
        EXPECT_GE(motion.channels.col(channel).minCoeff(), least - slack) << channel;
        EXPECT_LE(motion.channels.col(channel).maxCoeff(), most + slack) << channel;
    }
}

// One closing stroke of the lower lip: peak over mean velocity 1.875 for a minimum-jerk stroke, 1.63 to 2.09
// in real lips.
TEST(Gesture, StrokesHaveTheShapeOfRealOnes) {
    const ChannelMotion motion = gesture(spoken("pau:200 aa1:180 b:90 aa1:180 pau:200"));
    Eigen::Index open = 0, closed = 0;
    motion.channels.col(kLowerLip).segment(40, 32).minCoeff(&open);
    motion.channels.col(kLowerLip).segment(76, 18).maxCoeff(&closed);
    open += 40, closed += 76;
    const auto y = motion.channels.col(kLowerLip);
    double peak = 0;
    for (Eigen::Index k = open; k < closed; ++k) peak = std::max(peak, y(k + 1) - y(k));
    const double mean = (y(closed) - y(open)) / static_cast<double>(closed - open);
    EXPECT_GT(peak / mean, 1.5);
    EXPECT_LT(peak / mean, 2.3);
    const double duration = static_cast<double>(closed - open) / kGestureRate;
    EXPECT_GT(duration, 0.08);
    EXPECT_LT(duration, 0.2);
}

// Rounding is anticipated through consonants that do not insist on the lips.
TEST(Gesture, RoundsBeforeTheRoundedVowel) {
    const auto protrusion_in_k = [](const std::string& vowel) {
        const ChannelMotion motion = gesture(spoken("pau:200 ah1:120 k:100 " + vowel + ":150 pau:200"));
        return motion.channels(static_cast<Eigen::Index>(0.390 * kGestureRate), kProtrusion);
    };
    EXPECT_GT(protrusion_in_k("uw1"), protrusion_in_k("iy1") + 1);
}

TEST(Gesture, UnstressedVowelsAreReduced) {
    const auto drop = [](const std::string& vowel) {
        return gesture(spoken("pau:200 t:80 " + vowel + ":150 t:80 pau:200")).channels.col(kJaw).maxCoeff();
    };
    EXPECT_GT(drop("aa1"), drop("aa2"));
    EXPECT_GT(drop("aa2"), drop("aa0"));
}

TEST(Gesture, RepeatsToTheBit) {
    EXPECT_TRUE(gesture(spoken(kSentence)).channels == gesture(spoken(kSentence)).channels);
}

}  // namespace
}  // namespace viaface
