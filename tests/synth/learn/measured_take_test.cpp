// One sentence measured on a person by articulography: seven points of the layout on lips, jaw and tongue.
#include "synth/compare/compare_ema.hpp"
#include "synth/learn/held_out.hpp"
#include "synth/learn/learnt_talker.hpp"
#include "synth/say/recital.hpp"
#include "tests/synth/learn/folder.hpp"
#include "viapoints/another_person.hpp"
#include "viapoints/measured.hpp"
#include "viapoints/point_csv.hpp"
#include "viapoints/point_names.hpp"

namespace viaface {
namespace {

namespace fs = std::filesystem;

class MeasuredTake : public ::testing::Test {
  protected:
    void SetUp() override {
        const fs::path folder = fs::path(VIAFACE_SOURCE_DIR) / ".." / "shared" / "data" / "haskins_f01";
        if (!fs::exists(folder)) GTEST_SKIP() << "needs the recording in " << folder;
        static const Talker momo = load_talker(testing::kMomo);
        static const RecordedTakes read = takes_of(folder, momo);
        momo_ = &momo;
        takes_ = &read;
    }

    static RecordedTakes takes_of(const fs::path& folder, const Talker& momo) {
        const fs::path file = folder / "F01_B01_S01_R01_N.csv";
        const Motion own = lay_out(parse_point_csv(read_text(file, "motion"))).motion;
        const Configuration rest = momo.poser.drawn_points(momo.face.rest);
        Take take{"F01", read_ema(file, folder / "F01_B01_S01_R01_N.phones.txt").phones,
                  as_talker(own, measure_person(own, rest), rest)};
        auto& last = take.phones.phones.back();
        last.end = std::min(last.end,
                            static_cast<std::int64_t>(take.motion.time_s.back() * take.phones.sample_rate));
        RecordedTakes read{{{std::move(take), 1, false}}, {}};
        read.rest = common_rest(read.takes, "recordings");
        return read;
    }
    const Take& take() const { return takes_->takes[0].take; }
    LearntCodex learnt() const {
        return learn_from_takes(
            basis_of({&take()}, 0.1), takes_->rest, 1, [&](std::size_t) { return take(); }, "measured");
    }

    const Talker* momo_ = nullptr;
    const RecordedTakes* takes_ = nullptr;
};

double correlation(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
    const Eigen::VectorXd x = a.array() - a.mean(), y = b.array() - b.mean();
    return x.dot(y) / (x.norm() * y.norm());
}

TEST_F(MeasuredTake, ItsPointsAreTheTalkersAndNoOthers) {
    const std::vector<int> expected = {kLipCornerLeft, kBorderTop,  kBorderBottom, kLowerIncisor,
                                       kTongueTip,     kTongueBody, kTongueRear};
    EXPECT_EQ(measured_points(take().motion.positions, "motion"), expected);
}

TEST_F(MeasuredTake, IsCutIntoUnitsThatSayItAgain) {
    const LearntCodex codex = learnt();
    EXPECT_EQ(points_of(codex.codex.basis).size(), 7u);
    EXPECT_EQ(codex.codex.units.size() + codex.dropped.size(), take().phones.phones.size());
    EXPECT_LE(codex.dropped.size(), 3u);
    const Codex read = read_codex(write_codex(codex.codex));
    Utterance said;
    said.phones = take().phones;
    const RowMatrix spoken = recite(read, said).motion.at(take().motion.time_s);
    for (const int point : points_of(read.basis)) {
        const auto m = take().motion.positions.middleCols<3>(3 * point), s = spoken.middleCols<3>(3 * point);
        const RowMatrix spread = m.rowwise() - m.colwise().mean();
        EXPECT_LT((m - s).norm(), 0.5 * spread.norm()) << point_name(point);
    }
}

TEST_F(MeasuredTake, TheFaceEstimatesWhatWasNotMeasured) {
    const auto samples = take().motion.positions.rows();
    Eigen::VectorXd asked(samples), drawn(samples);
    for (Eigen::Index i = 0; i < samples; ++i) {
        const Configuration measured = take().motion.at(static_cast<std::size_t>(i));
        const Configuration whole = momo_->poser.completed(measured);
        ASSERT_TRUE(whole.allFinite());
        for (const int p : measured_points(measured.transpose(), "motion"))
            EXPECT_LT((point_of(whole, p) - point_of(measured, p)).norm(), 1e-9) << point_name(p);
        asked[i] = (point_of(whole, kBorderTop) - point_of(whole, kBorderBottom)).norm();
        drawn[i] = (point_of(whole, kInnerTop) - point_of(whole, kInnerBottom)).norm();
    }
    EXPECT_GT(correlation(asked, drawn), 0.9);
}

}  // namespace
}  // namespace viaface
