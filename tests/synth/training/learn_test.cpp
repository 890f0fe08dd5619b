// Few strings of phones, timed without a voice: what the whole corpus gives is printed by viaface_train.
#include "synth/training/learn.hpp"

#include <gtest/gtest.h>

#include "tests/synth/training/spoken.hpp"
#include "viapoints/codex_file.hpp"
#include "viapoints/codex_select.hpp"
#include "viapoints/codex_speak.hpp"
#include "viapoints/measured.hpp"
#include "viapoints/spline.hpp"

namespace viaface {
namespace {

namespace fs = std::filesystem;
using testing::spoken;

const fs::path kScans = fs::path(VIAFACE_SOURCE_DIR) / ".." / "shared" / "data" / "ict_facekit";

// All of p t f iy aa uw in CVC and VCV between pauses.
std::vector<PhoneSequence> small_corpus() {
    std::vector<PhoneSequence> corpus;
    for (const std::string c : {"p", "t", "f"}) {
        for (const std::string d : {"p", "t", "f"}) {
            for (const std::string v : {"iy1", "aa1", "uw1"}) {
                for (const std::string w : {"iy1", "aa1", "uw1"}) {
                    corpus.push_back(spoken("pau:150 " + c + ":80 " + v + ":120 " + d + ":90 " + w + ":140 " +
                                            c + ":90 pau:250"));
                }
            }
        }
    }
    return corpus;
}

class LearnTest : public ::testing::Test {
  protected:
    void SetUp() override {
        if (!fs::exists(kScans)) GTEST_SKIP() << "needs the scans in " << kScans;
        static const Performer performer{BlendHead(kScans)};
        static const Codex codex = learn_codex(performer, small_corpus());
        performer_ = &performer;
        codex_ = &codex;
    }
    Motion say(const PhoneSequence& phones) const {
        const MinimumJerkSpline spline(speak(*codex_, phones, select_units(*codex_, phones)),
                                       SplineEnd::at_rest(), SplineEnd::at_rest());
        Motion motion = performer_->perform(phones);
        motion.positions = to_points(codex_->basis, spline.at(motion.time_s));
        return motion;
    }

    const Performer* performer_ = nullptr;
    const Codex* codex_ = nullptr;
};

TEST_F(LearnTest, EveryPhoneOfTheCorpusBecomesAUnit) {
    const Coverage coverage = coverage_of(*codex_);
    EXPECT_EQ(coverage.phones, 7);
    EXPECT_EQ(coverage.diphones, 3 * 2 * 3 + 2 * 3);  // CV and VC, pau C and C pau
    EXPECT_EQ(coverage.missing_diphones.size(), 41u * 41 - 1 - 24);
    const SpokenShares shares = spoken_shares(*codex_, small_corpus());
    EXPECT_EQ(shares.exact, 1);
    EXPECT_EQ(shares.half, 0);
}

// The bound of the analysis is 0.5 mm; joins of units from different recitations may add as much again.
TEST_F(LearnTest, SpeaksWhatItWasTaughtAsItWasPerformed) {
    for (const PhoneSequence& phones : {small_corpus()[5], small_corpus()[40], small_corpus()[77]}) {
        const RowMatrix difference = say(phones).positions - performer_->perform(phones).positions;
        double farthest = 0;
        for (Eigen::Index k = 0; k < difference.rows(); ++k) {
            farthest = std::max(farthest, longest_triple(difference.row(k)));
        }
        EXPECT_LT(farthest, 1.0);
    }
}

TEST_F(LearnTest, SpeaksAnotherOrderWithClosedLips) {
    const PhoneSequence phones =
        spoken("pau:200 t:90 aa1:150 p:70 uw1:100 p:90 aa1:110 f:80 iy1:120 p:100 iy1:150 t:80 pau:300");
    const Motion motion = say(phones);
    for (const std::size_t i : {3, 5, 9}) {
        double gap = 1e9;
        for (std::size_t k = 0; k < motion.size(); ++k) {
            if (motion.time_s[k] < phones.begin_s(i) || motion.time_s[k] >= phones.end_s(i)) continue;
            const Configuration c = motion.at(k);
            gap = std::min(gap, point_of(c, kInnerTop).y() - point_of(c, kInnerBottom).y());
        }
        EXPECT_LT(gap, -1) << "phone " << i;
    }
}

TEST_F(LearnTest, RepeatsToTheByte) {
    EXPECT_EQ(write_codex(learn_codex(*performer_, small_corpus())), write_codex(*codex_));
}

}  // namespace
}  // namespace viaface
