#include "synth/learn/recorded_takes.hpp"

#include "tests/synth/learn/folder.hpp"
#include "viapoints/measured.hpp"

namespace viaface {
namespace {

namespace fs = std::filesystem;

using testing::expect_refused;

constexpr const char* kSentence = "My mother bought a boat.";
constexpr const char* kOther = "Rice is often served in round bowls.";

class RecordedTakesTest : public testing::InFolder {
  protected:
    RecordedTakes read() const { return read_takes(folder_, "recordings", testing::csv_motion); }
    void refused(const std::vector<std::string>& parts) const {
        expect_refused([&] { read(); }, parts);
    }
};

TEST_F(RecordedTakesTest, LabelledPhonesAndMotionAreThoseWritten) {
    const PerformedTake performed = put_take("a", kSentence);
    const RecordedTakes takes = read();
    ASSERT_EQ(takes.takes.size(), 1u);
    const RecordedTake& read = takes.takes[0];
    EXPECT_FALSE(read.aligned);
    EXPECT_EQ(read.take.motion.size(), performed.take.motion.size());
    EXPECT_LT((read.take.motion.positions - performed.take.motion.positions).cwiseAbs().maxCoeff(), 1e-9);
    ASSERT_EQ(read.take.phones.phones.size(), performed.take.phones.phones.size());
    const Configuration rest =
        to_points(testing::momo_codex().basis, testing::momo_codex().rest.transpose()).transpose();
    EXPECT_LT(longest_triple((takes.rest - rest).transpose()), 0.5);
}

TEST_F(RecordedTakesTest, WordsAreAlignedWhereThereAreNoLabels) {
    const PerformedTake performed = put_take("a", kSentence);
    fs::remove(folder_ / "a.TextGrid");
    put("a.txt", kSentence);
    std::string told;
    const RecordedTakes takes =
        read_takes(folder_, "recordings", testing::csv_motion, [&](auto& line) { told += line; });
    EXPECT_TRUE(takes.takes[0].aligned);
    EXPECT_GT(takes.takes[0].confidence, 0.9);
    EXPECT_NE(told.find("aligned"), std::string::npos);
    EXPECT_GE(takes.takes[0].take.phones.phones.size(), performed.take.phones.phones.size());
    put("a.txt", "Please pick those up.");
    refused({"a.txt", "confidence"});
    put("a.txt", "");
    refused({"a.txt"});
}

TEST_F(RecordedTakesTest, SoundAndMotionEndTogether) {
    PerformedTake performed = put_take("a", kSentence);
    Waveform sound = performed.utterance.sound;
    sound.samples.resize(sound.samples.size() / 2);
    put("a.wav", sound);
    refused({"a.TextGrid", "labels as long as the sound"});
    fs::remove(folder_ / "a.TextGrid");
    put("a.txt", "My mother.");
    refused({"a.csv", "motion that ends at"});
}

TEST_F(RecordedTakesTest, MotionThatIsNoneIsNamed) {
    const PerformedTake performed = put_take("a", kSentence);
    Motion motion = performed.take.motion;
    motion.positions(10, 3 * kChin) = std::numeric_limits<double>::quiet_NaN();
    put("a.csv", motion);
    refused({"a.csv", "chin", "sample 10"});
    put("a.csv", "time_s,lip_top_x_mm,lip_top_y_mm,lip_top_z_mm\n0,oops,1,1\n");
    refused({"a.csv", "oops"});
    motion = performed.take.motion;
    motion.time_s[5] += 0.005;
    put("a.csv", motion);
    refused({"a.csv", "sample 5", "fixed rate"});
    for (double& time : (motion = performed.take.motion).time_s) time *= 7;
    put("a.csv", motion);
    refused({"a.csv", "20 samples a second"});
}

// Every fourth sample of 100 a second: what a camera would have seen.
TEST_F(RecordedTakesTest, MotionAtTheRateOfAFilmGetsSamplesBetweenItsOwn) {
    const PerformedTake performed = put_take("a", kSentence);
    const Motion& fine = performed.take.motion;
    ASSERT_NEAR(fine.time_s[1] - fine.time_s[0], 0.01, 1e-9);
    Motion coarse;
    for (std::size_t i = 0; i < fine.size(); i += 4) coarse.time_s.push_back(fine.time_s[i]);
    coarse.positions = fine.positions(Eigen::seqN(0, std::ssize(coarse.time_s), 4), Eigen::all);
    put("a.csv", coarse);
    const RecordedTakes takes = read();
    const Motion& read = takes.takes[0].take.motion;
    EXPECT_EQ(read.size(), 2 * (coarse.size() - 1) + 1);  // 50 a second
    const RowMatrix own = read.positions(Eigen::seqN(0, std::ssize(coarse.time_s), 2), Eigen::all);
    EXPECT_LT((own - coarse.positions).cwiseAbs().maxCoeff(), 1e-6);
    double squares = 0;
    for (std::size_t i = 0; i < read.size(); ++i)
        squares += (read.at(i) - fine.at(2 * i)).squaredNorm() / kCoordinates;
    EXPECT_LT(std::sqrt(squares / static_cast<double>(read.size())), 0.2);  // mm rms
}

TEST_F(RecordedTakesTest, TakesHoldTheSamePointsInOneScaleAndPlace) {
    put_take("a", kSentence);
    const PerformedTake other = put_take("b", kOther);
    EXPECT_EQ(read().takes.size(), 2u);
    Motion motion = other.take.motion;
    motion.positions.middleCols<3>(3 * kNose).setConstant(std::numeric_limits<double>::quiet_NaN());
    put("b.csv", motion);
    refused({"b lacks nose", "as in a"});
    motion = other.take.motion;
    motion.positions *= 1.3;
    put("b.csv", motion);
    refused({"times the size"});
    motion = other.take.motion;
    for (int p = 0; p < kPoints; ++p) motion.positions.col(3 * p).array() += 30;
    put("b.csv", motion);
    refused({"mm apart"});
}

TEST_F(RecordedTakesTest, AMouthMayBeOpenBeforeATakeOrAfter) {
    put_take("a", kSentence);
    PerformedTake other = put_take("b", kOther);
    Motion& motion = other.take.motion;
    const double speaks_s = other.take.phones.end_s(0);
    for (int p = 0; p < kPoints; ++p) {
        for (Eigen::Index i = 0; i < motion.positions.rows(); ++i)
            if (motion.time_s[static_cast<std::size_t>(i)] < speaks_s) motion.positions(i, 3 * p + 1) -= 15;
    }
    put("b.csv", motion);
    EXPECT_EQ(read().takes.size(), 2u);
}

TEST_F(RecordedTakesTest, OnlyWhatBothRecordedIsCut) {
    const PerformedTake performed = put_take("a", kSentence);
    Motion motion = performed.take.motion;
    const auto rows = static_cast<Eigen::Index>(motion.size()) - 10;  // 0.1 s of the last pause
    motion.time_s.resize(static_cast<std::size_t>(rows));
    motion.positions = RowMatrix(motion.positions.topRows(rows));
    put("a.csv", motion);
    const PhoneSequence phones = read().takes[0].take.phones;
    EXPECT_LE(phones.end_s(phones.phones.size() - 1), motion.time_s.back());
    EXPECT_GT(phones.end_s(phones.phones.size() - 1), motion.time_s.back() - 0.01);
}

}  // namespace
}  // namespace viaface
