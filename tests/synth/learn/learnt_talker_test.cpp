#include "synth/learn/learnt_talker.hpp"

#include "synth/say/recital.hpp"
#include "tests/synth/learn/folder.hpp"
#include "viapoints/measured.hpp"

namespace viaface {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> kSentences = {"My mother bought a boat.",
                                             "Rice is often served in round bowls.",
                                             "These days a chicken leg is a rare dish."};

class LearntTalkerTest : public testing::InFolder {
  protected:
    RecordedTakes takes() const {
        RecordedTakes read;
        for (std::size_t i = 0; i < kSentences.size(); ++i) {
            const std::string name = "t" + std::to_string(i);
            read.takes.push_back({perform(testing::momo_codex(), name, kSentences[i], "rms").take, 1, false});
        }
        read.rest = common_rest(read.takes, "recordings");
        return read;
    }
};

TEST_F(LearntTalkerTest, SpeaksWhatItHeardAsItWasPerformed) {
    const RecordedTakes heard = takes();
    make_talker(heard, testing::kMomo, folder_ / "pupil");
    const Talker pupil = load_talker(folder_ / "pupil");
    EXPECT_EQ(pupil.name(), "pupil");
    EXPECT_NE(pupil.motion_provenance().find("3 recordings of 38 points: t0, t1, t2"), std::string::npos)
        << pupil.motion_provenance();
    EXPECT_EQ(pupil.description.at("provenance").at("recordings").size(), 3u);
    for (const RecordedTake& each : heard.takes) {
        Utterance said;
        said.phones = each.take.phones;
        const RowMatrix spoken = recite(pupil.codex, said).motion.at(each.take.motion.time_s);
        // The cut keeps every point within 2 mm of the motion, or drops the phone.
        EXPECT_LT(longest_triple(spoken - each.take.motion.positions), 2) << each.take.name;
    }
}

TEST_F(LearntTalkerTest, RepeatsToTheByte) {
    for (const char* name : {"one", "two"}) make_talker(takes(), testing::kMomo, folder_ / name);
    EXPECT_EQ(read_bytes(folder_ / "one" / "codex.via", "codex"),
              read_bytes(folder_ / "two" / "codex.via", "codex"));
}

TEST_F(LearntTalkerTest, PointsThatWereNotMeasuredStayOutOfTheCodex) {
    RecordedTakes read = takes();
    const std::vector<int> kept = {kBorderTop, kBorderBottom, kBorderLeft, kLowerIncisor, kTongueTip};
    for (RecordedTake& each : read.takes) {
        for (int p = 0; p < kPoints; ++p) {
            if (std::find(kept.begin(), kept.end(), p) != kept.end()) continue;
            each.take.motion.positions.middleCols<3>(3 * p).setConstant(
                std::numeric_limits<double>::quiet_NaN());
        }
    }
    read.rest = common_rest(read.takes, "recordings");
    make_talker(read, testing::kMomo, folder_ / "few");
    const Talker few = load_talker(folder_ / "few");
    EXPECT_EQ(points_of(few.codex.basis).size(), kept.size());
    Utterance said;
    said.phones = read.takes[0].take.phones;
    const Configuration middle = recite(few.codex, said).motion.at(1.0);
    EXPECT_TRUE(point_of(middle, kBorderTop).allFinite());
    EXPECT_TRUE(point_of(middle, kNose).array().isNaN().all());
    EXPECT_TRUE(few.poser.completed(middle).allFinite());  // what is drawn
}

TEST_F(LearntTalkerTest, ToldIsWhatTheCodexHolds) {
    const LearntTalker talker = make_talker(takes(), testing::kMomo, folder_ / "pupil");
    const Coverage coverage = coverage_of(talker.learnt.codex);
    EXPECT_EQ(coverage.phones + static_cast<int>(coverage.missing_phones.size()),
              static_cast<int>(phone_table().size()));
    EXPECT_NEAR(talker.shares.exact + talker.shares.of_class + talker.shares.half, 1, 1e-9);
    EXPECT_NE(as_text(talker).find("phones missing: "), std::string::npos);
}

TEST_F(LearntTalkerTest, NeverOverwritesAndLeavesNothingHalfDone) {
    fs::create_directory(folder_ / "pupil");
    put("pupil/talker.json", "{}");
    testing::expect_refused([&] { make_talker(takes(), testing::kMomo, folder_ / "pupil"); },
                            {"new or empty"});
    testing::expect_refused([&] { make_talker(takes(), folder_ / "none", folder_ / "other"); },
                            {"talker.json"});
    EXPECT_FALSE(fs::exists(folder_ / "other"));
}

}  // namespace
}  // namespace viaface
