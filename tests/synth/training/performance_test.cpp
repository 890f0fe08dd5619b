#include "synth/training/performance.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/synth/training/spoken.hpp"

namespace viaface {
namespace {

namespace fs = std::filesystem;
using testing::spoken;

const fs::path kData = fs::path(VIAFACE_SOURCE_DIR) / ".." / "shared" / "data";

class PerformerTest : public ::testing::Test {
  protected:
    void SetUp() override {
        if (!fs::exists(kData / "ict_facekit"))
            GTEST_SKIP() << "needs the scans in " << kData / "ict_facekit";
        static const Performer shared{BlendHead(kData / "ict_facekit")};
        performer_ = &shared;
    }
    const Performer* performer_ = nullptr;
};

double gap(const Configuration& c, Point top = kInnerTop, Point bottom = kInnerBottom) {
    return point_of(c, top).y() - point_of(c, bottom).y();
}
constexpr double kOverEdge = 1.5;  // mm: what the lower lip may cover of the upper teeth

double width(const Configuration& c) { return point_of(c, kBorderLeft).x() - point_of(c, kBorderRight).x(); }

// Samples of a phone.
struct Span {
    std::size_t first, last;
};
Span span_of(const PhoneSequence& phones, std::size_t i) {
    return {static_cast<std::size_t>(std::ceil(phones.begin_s(i) * kGestureRate)),
            static_cast<std::size_t>(phones.end_s(i) * kGestureRate)};
}

template <class Value>
double least(const Motion& motion, Span span, Value value) {
    double result = 1e9;
    for (std::size_t k = span.first; k <= span.last; ++k) result = std::min(result, value(motion.at(k)));
    return result;
}

std::vector<std::string> vowels() {
    std::vector<std::string> names;
    for (const PhoneInfo& info : phone_table()) {
        if (info.vowel) names.emplace_back(info.name);
    }
    return names;
}

std::string vcv(const std::string& first, const std::string& consonant, const std::string& second, int ms) {
    return "pau:200 " + first + ":130 " + consonant + ":" + std::to_string(ms) + " " + second +
           ":130 pau:200";
}

TEST_F(PerformerTest, RestIsTheNeutralHead) {
    EXPECT_LT(
        (performer_->configuration(Performer::Channels::Zero()) - performer_->rest()).cwiseAbs().maxCoeff(),
        1e-9);
}

TEST_F(PerformerTest, LipsAreTogetherInAPauseAndNotPressed) {
    const Configuration c = performer_->resting();
    for (const auto& [top, bottom] :
         {std::pair{kInnerTop, kInnerBottom}, std::pair{kInnerTopLeft, kInnerBottomLeft},
          std::pair{kInnerTopRight, kInnerBottomRight}}) {
        EXPECT_LE(gap(c, top, bottom), 0);
        EXPECT_GT(gap(c, top, bottom), -0.6);
    }
}

// Channels are what the points do, wherever the shapes' combination is exact.
TEST_F(PerformerTest, ChannelsAreMillimetresOfThePoints) {
    Performer::Channels channels = Performer::Channels::Zero();
    channels << 5, 1.5, -6, -3, 2.5, 0, 0, 0, 0, 0;
    const Configuration c = performer_->configuration(channels), moved = c - performer_->rest();
    EXPECT_NEAR(point_of(moved, kInnerBottom).y(), -6, 0.4);
    EXPECT_NEAR(point_of(moved, kInnerTop).y(), 1.5, 0.4);
    EXPECT_NEAR(point_of(moved, kLowerIncisor).y(), -5, 1e-3);
    EXPECT_NEAR(width(c) - width(performer_->rest()), -3, 1.5);
    const double forward = (point_of(moved, kBorderTop).z() + point_of(moved, kBorderBottom).z()) / 2;
    EXPECT_NEAR(forward, 2.5, 2.5);  // the jaw swings back
}

TEST_F(PerformerTest, BilabialsClosePastContactBetweenAllVowels) {
    for (const std::string consonant : {"b", "p", "m"}) {
        for (const int ms : {50, 80, 120}) {
            for (const std::string& first : vowels()) {
                for (const std::string& second : vowels()) {
                    const PhoneSequence phones = spoken(vcv(first, consonant, second, ms));
                    const Motion motion = performer_->perform(phones);
                    const Span span = span_of(phones, 2);
                    std::size_t tightest = span.first;
                    for (std::size_t k = span.first - 4; k <= span.last + 4; ++k) {
                        if (gap(motion.at(k)) < gap(motion.at(tightest))) tightest = k;
                    }
                    const std::string what =
                        first + " " + consonant + " " + second + " " + std::to_string(ms);
                    const Configuration c = motion.at(tightest);
                    EXPECT_LT(gap(c), -1) << what;
                    EXPECT_LT(gap(c, kInnerTopLeft, kInnerBottomLeft), 0) << what;
                    EXPECT_GE(motion.time_s[tightest], phones.begin_s(2)) << what;
                    EXPECT_LE(motion.time_s[tightest], phones.end_s(2)) << what;
                    const double centre = (phones.begin_s(2) + phones.end_s(2)) / 2;
                    EXPECT_NEAR(motion.time_s[tightest], centre - std::min(0.026, 0.3 * ms / 1000), 0.020)
                        << what;
                }
            }
        }
    }
}

TEST_F(PerformerTest, LabiodentalsBringTheLowerLipToTheUpperIncisors) {
    for (const std::string consonant : {"f", "v"}) {
        for (const std::string& first : vowels()) {
            for (const std::string& second : vowels()) {
                const PhoneSequence phones = spoken(vcv(first, consonant, second, 90));
                const double nearest =
                    least(performer_->perform(phones), span_of(phones, 2), [](const Configuration& c) {
                        Eigen::Vector3d lip = point_of(c, kInnerBottom);  // the origin lies on their edge
                        lip.y() -= std::clamp(lip.y(), 0.0, kOverEdge);
                        return lip.norm();
                    });
                EXPECT_LT(nearest, 1) << first << " " << consonant << " " << second;
            }
        }
    }
}

TEST_F(PerformerTest, StressedOpenVowelsOpenBetweenAnyConsonants) {
    for (const std::string vowel : {"aa1", "ae1", "aw1", "ay1"}) {
        for (const std::string consonant : {"b", "f", "t", "s", "sh", "k", "w", "r", "l"}) {
            const PhoneSequence phones =
                spoken("pau:200 " + consonant + ":90 " + vowel + ":150 " + consonant + ":90 pau:200");
            const double widest = -least(performer_->perform(phones), span_of(phones, 2),
                                         [](const Configuration& c) { return -gap(c); });
            EXPECT_GT(widest, 8) << consonant << " " << vowel;
        }
    }
}

TEST_F(PerformerTest, RoundedVowelsAreNarrowerThanSpreadOnes) {
    const auto extreme = [&](const std::string& consonant, const std::string& vowel, double sign) {
        const PhoneSequence phones =
            spoken("pau:200 " + consonant + ":80 " + vowel + ":120 " + consonant + ":80 pau:200");
        return sign * least(performer_->perform(phones), span_of(phones, 2),
                            [&](const Configuration& c) { return sign * width(c); });
    };
    for (const std::string consonant : {"b", "f", "t", "s", "sh", "k", "r", "l"}) {
        EXPECT_GT(extreme(consonant, "iy1", -1) - extreme(consonant, "uw1", 1), 4) << consonant;
    }
}

TEST_F(PerformerTest, FollowsAMeasuredTalker) {
    testing::expect_follows_a_measured_talker(
        [this](const PhoneSequence& phones) { return performer_->perform(phones); });
}

}  // namespace
}  // namespace viaface
