// The built-in talker's codex as committed: how it covers and speaks sentences that it never recited, and how
// it follows a measured talker. Points as commanded, before contact.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "base/whole_file.hpp"
#include "synth/learn/sentences.hpp"
#include "synth/training/corpus.hpp"
#include "synth/training/learn.hpp"
#include "tests/synth/training/spoken.hpp"
#include "viapoints/codex_file.hpp"
#include "viapoints/codex_select.hpp"
#include "viapoints/codex_speak.hpp"
#include "viapoints/spline.hpp"

namespace viaface {
namespace {

namespace fs = std::filesystem;
const fs::path kRoot = VIAFACE_SOURCE_DIR;
const fs::path kCodex = kRoot / "talkers/momo/codex.via";

class TaughtCodex : public ::testing::Test {
  protected:
    void SetUp() override {
        if (!fs::exists(kCodex)) GTEST_SKIP() << "needs " << kCodex << " (viaface talker make)";
        static const Codex shared = read_codex(read_bytes(kCodex, "codex"));
        codex_ = &shared;
    }
    Motion say(const PhoneSequence& phones) const {
        constexpr double kRate = 200;  // Hz
        const MinimumJerkSpline spline(speak(*codex_, phones, select_units(*codex_, phones)),
                                       SplineEnd::at_rest(), SplineEnd::at_rest());
        Motion motion;
        const double end = phones.end_s(phones.phones.size() - 1);
        for (int k = 0; k <= end * kRate + 1; ++k) motion.time_s.push_back(k / kRate);
        motion.positions = to_points(codex_->basis, spline.at(motion.time_s));
        return motion;
    }

    const Codex* codex_ = nullptr;
};

const std::vector<PhoneSequence>& held_out() {
    static const auto phones = timed_corpus(read_sentences(kRoot / "tests/synth/training/held_out.txt"), {});
    return phones;
}

TEST_F(TaughtCodex, HoldsEveryDiphone) {
    const Coverage coverage = coverage_of(*codex_);
    EXPECT_EQ(coverage.phones, static_cast<int>(phone_table().size()));
    EXPECT_TRUE(coverage.missing_diphones.empty()) << coverage.missing_diphones.front();
}

TEST_F(TaughtCodex, SpeaksUnseenSentencesFromExactTriphones) {
    const SpokenShares shares = spoken_shares(*codex_, held_out());
    RecordProperty("exact_percent", std::to_string(100 * shares.exact));
    RecordProperty("half_percent", std::to_string(100 * shares.half));
    EXPECT_GT(shares.exact, 0.6);
    EXPECT_LT(shares.half, 0.02);
}

// Extremes of a figure within a phone.
struct Range {
    double least = 1e9, most = -1e9;
};
template <class Figure>
Range range_of(const Motion& motion, const PhoneSequence& phones, std::size_t i, Figure figure) {
    Range range;
    for (std::size_t k = 0; k < motion.size(); ++k) {
        if (motion.time_s[k] < phones.begin_s(i) || motion.time_s[k] >= phones.end_s(i)) continue;
        const double value = figure(motion.at(k));
        range = {std::min(range.least, value), std::max(range.most, value)};
    }
    return range;
}
double gap(const Configuration& c, Point top, Point bottom) {
    return point_of(c, top).y() - point_of(c, bottom).y();
}
double middle_gap(const Configuration& c) { return gap(c, kInnerTop, kInnerBottom); }
double widest_gap(const Configuration& c) {
    return std::max(
        {middle_gap(c), gap(c, kInnerTopLeft, kInnerBottomLeft), gap(c, kInnerTopRight, kInnerBottomRight)});
}
double width(const Configuration& c) { return point_of(c, kBorderLeft).x() - point_of(c, kBorderRight).x(); }
double lip_to_incisors(const Configuration& c) { return point_of(c, kInnerBottom).norm(); }

TEST_F(TaughtCodex, ClosesOpensRoundsAndTucksInUnseenSentences) {
    constexpr std::array kOpen = {"aa", "ae", "ao", "aw", "ay"};
    Range rounded, spread;
    for (const PhoneSequence& phones : held_out()) {
        const Motion motion = say(phones);
        for (std::size_t i = 0; i < phones.phones.size(); ++i) {
            const PhoneInfo& phone = phone_info(phones.phones[i].phone);
            const bool stressed = phones.phones[i].stress == 1;
            const std::string where = std::string(phone.name) + " at " + std::to_string(phones.begin_s(i));
            if (phone.viseme == VisemeClass::kBilabial) {
                EXPECT_LT(range_of(motion, phones, i, widest_gap).least, 0) << where;
            } else if (phone.viseme == VisemeClass::kLabiodental) {
                EXPECT_LT(range_of(motion, phones, i, lip_to_incisors).least, 1) << where;
            } else if (stressed && std::find(kOpen.begin(), kOpen.end(), phone.name) != kOpen.end()) {
                EXPECT_GT(range_of(motion, phones, i, middle_gap).most, 8) << where;
            } else if (stressed && phone.name == "uw") {
                rounded.most = std::max(rounded.most, range_of(motion, phones, i, width).least);
            } else if (stressed && phone.name == "iy") {
                spread.least = std::min(spread.least, range_of(motion, phones, i, width).most);
            }
        }
    }
    EXPECT_GT(spread.least - rounded.most, 4);
}

TEST_F(TaughtCodex, FollowsAMeasuredTalker) {
    testing::expect_follows_a_measured_talker([this](const PhoneSequence& phones) { return say(phones); });
}

}  // namespace
}  // namespace viaface
