// A codex learned from a talker's recitations speaks those that were left out of it.
#include "synth/learn/held_out.hpp"

#include "synth/learn/sentences.hpp"
#include "tests/synth/learn/folder.hpp"

namespace viaface {
namespace {

RecordedTakes recitations(std::size_t count) {
    const auto sentences = read_sentences(testing::kMomo / "corpus.txt");
    RecordedTakes read;
    for (std::size_t i = 0; i < count; ++i) {
        read.takes.push_back(
            {perform(testing::momo_codex(), std::to_string(i), sentences.at(i), "rms").take, 1, false});
    }
    read.rest = common_rest(read.takes, "recordings");
    return read;
}

const HeldOutFigures& fifth_left_out() {
    static const HeldOutFigures figures = check_held_out(recitations(50), 0.2, "left out");
    return figures;
}

TEST(HeldOut, EveryFifthIsLeftOut) {
    EXPECT_EQ(fifth_left_out().learned, 40u);
    EXPECT_EQ(fifth_left_out().left_out.size(), 10u);
    EXPECT_EQ(fifth_left_out().points.size(), static_cast<std::size_t>(kPoints));
}

// Speaking the mean posture all the time would be wrong by the spread of a point, with r = 0.
TEST(HeldOut, SpokenPointsFollowTheRecited) {
    RecordProperty("figures", as_text(fifth_left_out()));
    for (const PointFigures& each : fifth_left_out().points) {
        if (each.spread_mm < 0.3) continue;  // it hardly moves
        EXPECT_LT(each.rms_mm, each.spread_mm) << point_name(each.point);
        EXPECT_GT(each.correlation, 0.6) << point_name(each.point);
    }
    for (const int lip : {static_cast<int>(kInnerBottom), static_cast<int>(kLowerIncisor)})
        EXPECT_GT(fifth_left_out().points[static_cast<std::size_t>(lip)].correlation, 0.8) << point_name(lip);
    ASSERT_EQ(fifth_left_out().lengths.size(), 2u);
    EXPECT_GT(fifth_left_out().lengths[0].correlation, 0.8) << fifth_left_out().lengths[0].name;
    EXPECT_LT(fifth_left_out().rms_mm, 0.7 * fifth_left_out().spread_mm);
}

TEST(HeldOut, WrongSharesAreRefused) {
    const RecordedTakes two = recitations(2);
    for (const double share : {0.0, -1.0, 0.6, std::nan("")})
        testing::expect_refused([&] { check_held_out(two, share, "--left-out"); }, {"--left-out"});
    RecordedTakes one = two;
    one.takes.pop_back();
    testing::expect_refused([&] { check_held_out(one, 0.2, "--left-out"); }, {"two takes"});
    EXPECT_EQ(check_held_out(two, 0.2, "--left-out").left_out.size(), 1u);
}

}  // namespace
}  // namespace viaface
