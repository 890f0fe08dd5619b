#include "viapoints/via_spacing.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/viapoints/recited.hpp"

namespace viaface {
namespace {

RankedTrack ranked(std::vector<double> times, std::vector<double> places, std::vector<ViaRank> ranks) {
    RankedTrack track{{std::move(times), RowMatrix(std::ssize(places), 1)},
                      std::move(ranks),
                      std::vector<int>(places.size(), 0)};
    for (std::size_t i = 0; i < places.size(); ++i)
        track.track.points(static_cast<Eigen::Index>(i), 0) = places[i];
    return track;
}

TEST(ViaSpacing, TheHigherRankStaysAndEqualsMeet) {
    using enum ViaRank;
    const RankedTrack thin =
        thinned(ranked({0, 0.1, 0.11, 0.2, 0.21, 0.3, 0.31, 0.4}, {0, 1, 2, 3, 4, 5, 6, 7},
                       {kRest, kBilabial, kNucleus, kPassing, kNucleus, kNucleus, kNucleus, kRest}),
                0.02, 0.02);
    EXPECT_EQ(thin.track.time_s, (std::vector<double>{0, 0.1, 0.21, (0.3 + 0.31) / 2, 0.4}));
    EXPECT_EQ(thin.track.points.reshaped<Eigen::RowMajor>().transpose(),
              (Eigen::RowVectorXd(5) << 0, 1, 4, 5.5, 7).finished());
    EXPECT_EQ(thin.rank, (std::vector<ViaRank>{kRest, kBilabial, kNucleus, kNucleus, kRest}));
}

TEST(ViaSpacing, InsideARunPointsMayComeCloser) {
    RankedTrack track =
        ranked({0, 0.1, 0.115, 0.13}, {0, 1, 2, 3}, std::vector<ViaRank>(4, ViaRank::kPassing));
    track.run = {0, 0, 0, 1};
    EXPECT_EQ(thinned(track, 0.02, 0.01).track.time_s, (std::vector<double>{0, 0.1, (0.115 + 0.13) / 2}));
}

TEST(ViaSpacing, ThinnedTracksHaveNoGapUnderTheLeastWhateverTheyWere) {
    recited::Random random(5);
    for (int round = 0; round < 200; ++round) {
        std::vector<double> times, places;
        std::vector<ViaRank> ranks;
        for (double t = 0; t < 1; t += random.uniform(0, 0.05)) {
            times.push_back(t);
            places.push_back(random.uniform(-1, 1));
            ranks.push_back(static_cast<ViaRank>(random.below(5)));
        }
        const RankedTrack thin = thinned(ranked(times, places, ranks), 0.02, 0.02);
        for (std::size_t i = 1; i < thin.rank.size(); ++i)
            EXPECT_GE(thin.track.time_s[i] - thin.track.time_s[i - 1], 0.02);
        for (std::size_t i = 1; i < times.size(); ++i) {
            // a bilabial without a bilabial or a rest near it is kept as it is
            bool alone = ranks[i] == ViaRank::kBilabial;
            for (std::size_t j = 0; j < times.size(); ++j) {
                alone = alone &&
                        (j == i || ranks[j] < ViaRank::kBilabial || std::abs(times[j] - times[i]) > 0.06);
            }
            EXPECT_TRUE(!alone ||
                        std::count(thin.track.time_s.begin(), thin.track.time_s.end(), times[i]) == 1);
        }
    }
}

TEST(ViaSpacing, GradedGapsStayWithinTheRatioAndAreNotTiny) {
    recited::Random random(6);
    for (int round = 0; round < 200; ++round) {
        std::vector<double> times{0};
        double smallest = 1e9;
        for (int i = 0; i < 10; ++i) {
            const double gap = 0.02 * std::pow(100.0, random.uniform(0, 1));
            smallest = std::min(smallest, gap);
            times.push_back(times.back() + gap);
        }
        for (const double ratio : {2.0, 3.0, 4.0}) {
            std::vector<double> all = grading_times(times, ratio);
            EXPECT_LT(all.size(), 200u);
            all.insert(all.end(), times.begin(), times.end());
            std::sort(all.begin(), all.end());
            for (std::size_t i = 2; i < all.size(); ++i) {
                const double r = (all[i] - all[i - 1]) / (all[i - 1] - all[i - 2]);
                EXPECT_LE(std::max(r, 1 / r), ratio * 1.0001);
                EXPECT_GE(all[i] - all[i - 1], std::min(smallest, kMaxViaGap / 2) * 0.9999);
                EXPECT_LE(all[i] - all[i - 1], kMaxViaGap * 1.0001);
            }
        }
    }
    EXPECT_TRUE(grading_times({0, 0.1, 0.25, 0.35}, 3).empty());
    EXPECT_TRUE(grading_times({}, 3).empty());
    EXPECT_THROW(grading_times({0, 1}, 1), std::invalid_argument);
}

TEST(ViaSpacing, TheMonotoneCubicNeverLeavesTheRangeOfItsNeighbours) {
    recited::Random random(8);
    ViaPointTrack track{{0}, RowMatrix(12, 2)};
    for (int i = 1; i < 12; ++i) track.time_s.push_back(track.time_s.back() + random.uniform(0.02, 0.6));
    for (double& value : track.points.reshaped()) value = random.uniform(-5, 5);
    const MonotoneCubic cubic(track);
    for (std::size_t i = 0; i + 1 < track.time_s.size(); ++i) {
        const auto row = static_cast<Eigen::Index>(i);
        EXPECT_LT((cubic.at(track.time_s[i]) - track.points.row(row)).norm(), 1e-12);
        for (double x = 0; x <= 1; x += 0.01) {
            const auto here = cubic.at(track.time_s[i] + x * (track.time_s[i + 1] - track.time_s[i]));
            for (int d = 0; d < 2; ++d) {
                const auto [low, high] = std::minmax(track.points(row, d), track.points(row + 1, d));
                EXPECT_TRUE(here[d] >= low - 1e-9 && here[d] <= high + 1e-9);
            }
        }
    }
}

}  // namespace
}  // namespace viaface
