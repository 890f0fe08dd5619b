#include "viapoints/analysis.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "base/error.hpp"
#include "tests/viapoints/haskins.hpp"
#include "tests/viapoints/smooth_motion.hpp"
#include "viapoints/measured.hpp"

namespace viaface {
namespace {

using Eigen::Index;

// The largest distance by its definition, with nothing shared with the code under test.
double largest_error(const Motion& motion, const RowMatrix& recovered) {
    double largest = 0;
    for (std::size_t i = 0; i < motion.size(); ++i) {
        const Configuration was = motion.at(i), is = recovered.row(static_cast<Index>(i)).transpose();
        for (int p = 0; p < kPoints; ++p) {
            if (point_of(was, p).hasNaN()) continue;
            const double distance = (point_of(was, p) - point_of(is, p)).norm();
            EXPECT_FALSE(std::isnan(distance));
            largest = std::max(largest, distance);
        }
    }
    return largest;
}

void expect_bound_holds(const Motion& motion, double bound) {
    const Analysis analysis = analyse_in_full(motion, {bound});
    const double error = largest_error(motion, recover(analysis.track, motion.time_s));
    EXPECT_LE(error, bound);
    EXPECT_NEAR(error, analysis.max_error_mm, 1e-12);
    EXPECT_LE(analysis.rms_error_mm, analysis.max_error_mm);
    EXPECT_GT(analysis.max_error_mm, 0.2 * bound) << "a bound that is not used is a bound on something else";
    EXPECT_EQ(analysis.track.time_s.front(), motion.time_s.front());
    EXPECT_EQ(analysis.track.time_s.back(), motion.time_s.back());
}

TEST(Analysis, HoldsTheBoundAtEverySampleOfRandomMotions) {
    for (const std::uint64_t seed : {1u, 2u, 3u}) {
        for (const int points : {1, 18, 38}) {
            for (const double bound : {0.05, 0.5, 2.0}) {
                SCOPED_TRACE(testing::Message() << seed << " " << points << " points, bound " << bound);
                expect_bound_holds(smooth_motion(seed, 6, 120, points), bound);
            }
        }
    }
}

TEST(Analysis, HoldsTheBoundOnNoiseAndOnUnevenTimes) {
    Motion motion = smooth_motion(4, 4, 100, 8);
    Dice dice(9);
    for (Index i = 0; i < motion.positions.rows(); ++i) {
        motion.time_s[static_cast<std::size_t>(i)] += 0.009 * dice.uniform();
        for (Index d = 0; d < 24; ++d) motion.positions(i, d) += 0.1 * dice.normal();
    }
    for (const double bound : {0.5, 1.0}) expect_bound_holds(motion, bound);
}

TEST(Analysis, FewerViaPointsServeALargerBound) {
    const Motion motion = smooth_motion(5, 20, 120, 18);
    std::size_t before = motion.size();
    for (const double bound : {0.01, 0.05, 0.25, 0.5, 1.0, 2.0, 4.0}) {
        const std::size_t count = analyse(motion, {bound}).time_s.size();
        EXPECT_LT(count, before) << bound;
        before = count;
    }
    EXPECT_LT(before, 20 * 12u) << "6 Hz motion needs no more than 12 via points a second";
}

TEST(Analysis, TheSplineOfViaPointsIsFoundAgainWithFewMore) {
    ViaPointTrack track{{}, RowMatrix::Constant(20, kCoordinates, std::nan(""))};
    Dice dice(6);
    for (Index i = 0; i < 20; ++i) {
        track.time_s.push_back(0.16 * static_cast<double>(i));
        for (Index d = 0; d < 54; ++d) track.points(i, d) = 10 * dice.normal();
    }
    Motion motion;
    for (int i = 0; i <= 19 * 16; ++i) motion.time_s.push_back(i * 0.01);
    motion.positions = recover(track, motion.time_s);
    EXPECT_LE(analyse(motion, {0.5}).time_s.size(), 30u) << "half as many again as the 20 that made it";
}

TEST(Analysis, AMotionAtRestIsItsTwoEnds) {
    Motion motion = smooth_motion(7, 5, 100, 4);
    motion.positions.rowwise() = motion.positions.row(0).eval();
    const Analysis analysis = analyse_in_full(motion);
    EXPECT_EQ(analysis.track.time_s, (std::vector<double>{0, motion.time_s.back()}));
    EXPECT_LT(analysis.max_error_mm, 1e-12);
}

TEST(Analysis, WorkIsLinearInLength) {
    const auto work = [](double seconds) {
        return static_cast<double>(analyse_in_full(smooth_motion(8, seconds, 120, 18)).evaluations);
    };
    const double once = work(20), twice = work(40), fourfold = work(80);
    EXPECT_LT(twice / once, 2.3);
    EXPECT_LT(fourfold / twice, 2.2);
}

TEST(Analysis, PointsThatWereNeverMeasuredStayMissing) {
    const Motion motion = smooth_motion(9, 3, 100, 5);
    const ViaPointTrack track = analyse(motion);
    EXPECT_TRUE(track.points.leftCols(15).allFinite());
    EXPECT_TRUE(track.points.rightCols(kCoordinates - 15).array().isNaN().all());
}

TEST(Analysis, InABasisTheBoundIsStillMillimetresAtEachPoint) {
    const Motion motion = smooth_motion(10, 8, 100, kPoints, 9);
    const ConfigurationBasis full = principal_basis(motion.positions, 9);
    for (const double bound : {0.1, 1.0}) {
        const Analysis analysis = analyse_in_full(motion, full, {bound});
        EXPECT_EQ(analysis.track.points.cols(), 9);
        const double error = largest_error(motion, to_points(full, recover(analysis.track, motion.time_s)));
        EXPECT_LE(error, bound);
        EXPECT_NEAR(error, analysis.max_error_mm, 1e-9);
        // the same motion in other coordinates, in which points cannot be fitted one by one
        const auto count = static_cast<double>(analyse(motion, {bound}).time_s.size());
        EXPECT_NEAR(static_cast<double>(analysis.track.time_s.size()), count, 0.2 * count);
    }
    const ConfigurationBasis small = principal_basis(motion.positions, 8);
    const double own = truncation_error_mm(small, motion.positions);
    const Analysis analysis = analyse_in_full(motion, small, {own + 0.3});
    EXPECT_LE(largest_error(motion, to_points(small, recover(analysis.track, motion.time_s))), own + 0.3);
    EXPECT_THROW(analyse(motion, small, {own * 0.9}), InputError);
}

// The tracks side by side at the motion's times; dimensions without a track are NaN.
RowMatrix recovered(const std::vector<ViaPointTrack>& tracks, const std::vector<double>& time_s) {
    RowMatrix all = RowMatrix::Constant(static_cast<Index>(time_s.size()), std::ssize(tracks), std::nan(""));
    for (std::size_t d = 0; d < tracks.size(); ++d) {
        if (!tracks[d].time_s.empty()) all.col(static_cast<Index>(d)) = recover(tracks[d], time_s);
    }
    return all;
}

TEST(Analysis, WithTimesOfTheirOwnTheBoundHoldsAtEachPoint) {
    const Motion motion = smooth_motion(17, 6, 100, 5);
    for (const double bound : {0.2, 1.0}) {
        const SeparateAnalysis analysis = analyse_separately(motion, {bound});
        ASSERT_EQ(analysis.tracks.size(), static_cast<std::size_t>(kCoordinates));
        for (std::size_t d = 0; d < analysis.tracks.size(); ++d)
            EXPECT_EQ(analysis.tracks[d].time_s.empty(), d >= 15) << d;
        const double error = largest_error(motion, recovered(analysis.tracks, motion.time_s));
        EXPECT_LE(error, bound);
        EXPECT_NEAR(error, analysis.max_error_mm, 1e-12);
        EXPECT_GT(error, 0.2 * bound);
    }
}

TEST(Analysis, ComponentsWithTimesOfTheirOwnKeepTheBoundAtEachPoint) {
    const Motion motion = smooth_motion(18, 6, 100, kPoints, 4);
    const ConfigurationBasis basis = principal_basis(motion.positions, 4);
    const SeparateAnalysis analysis = analyse_separately(motion, basis, {1.0});
    ASSERT_EQ(analysis.tracks.size(), 4u);
    const double error = largest_error(motion, to_points(basis, recovered(analysis.tracks, motion.time_s)));
    EXPECT_LE(error, 1.0);
    EXPECT_NEAR(error, analysis.max_error_mm, 1e-9);
}

// A still coordinate needs its two ends, however much another moves.
TEST(Analysis, WithTimesOfTheirOwnWhatIsStillHasTwoViaPoints) {
    Motion motion = smooth_motion(19, 4, 100, 1);
    motion.positions.col(1).setConstant(7);
    const SeparateAnalysis analysis = analyse_separately(motion, {0.2});
    EXPECT_EQ(analysis.tracks[1].time_s.size(), 2u);
    EXPECT_GT(analysis.tracks[0].time_s.size(), 4u);
}

TEST(Analysis, TwiceGivesTheSame) {
    const Motion motion = smooth_motion(11, 6, 120, 18);
    const ViaPointTrack one = analyse(motion), other = analyse(motion);
    EXPECT_EQ(one.time_s, other.time_s);
    EXPECT_EQ(one.points.leftCols(54), other.points.leftCols(54));
}

TEST(Analysis, TwoSamplesAreTwoViaPoints) {
    Motion motion = smooth_motion(12, 1, 50, 3);
    motion.time_s.resize(2);
    motion.positions = motion.positions.topRows(2).eval();
    EXPECT_EQ(analyse(motion).time_s, motion.time_s);
}

double largest_gap_ratio(const std::vector<double>& time_s) {
    double largest = 1;
    for (std::size_t i = 2; i < time_s.size(); ++i) {
        const double ratio = (time_s[i] - time_s[i - 1]) / (time_s[i - 1] - time_s[i - 2]);
        largest = std::max({largest, ratio, 1 / ratio});
    }
    return largest;
}

TEST(Analysis, NeighbouringGapsKeepTheirRatio) {
    const Motion motion = smooth_motion(14, 10, 120, 18);
    for (const double ratio : {2.0, 3.0, 4.0}) {
        for (const double bound : {0.1, 1.0}) {
            EXPECT_LE(largest_gap_ratio(analyse(motion, {bound, ratio}).time_s), 1.001 * ratio);
        }
    }
}

// 0.1 mm of noise in each coordinate, of which a 3-D distance reaches 0.45 mm in one of 100,000: what stays
// within 0.5 mm of it need not follow it.
TEST(Analysis, NoiseWithinTheBoundIsNotFollowed) {
    Motion motion = smooth_motion(15, 20, 60, 18);
    const std::size_t clean = analyse(motion, {0.5}).time_s.size();
    Dice dice(16);
    for (double& coordinate : motion.positions.leftCols(54).reshaped()) coordinate += 0.1 * dice.normal();
    EXPECT_LT(analyse(motion, {0.5}).time_s.size(), 1.5 * static_cast<double>(clean));
}

TEST(Analysis, RubbishIsRefused) {
    const Motion motion = smooth_motion(13, 1, 50, 3);
    const double nan = std::nan("");
    for (const double bound : {0.0, -1.0, nan, 1e9}) EXPECT_THROW(analyse(motion, {bound}), InputError);
    for (const double ratio : {1.9, -3.0, nan, 1001.0}) EXPECT_THROW(analyse(motion, {1, ratio}), InputError);
    const auto changed = [&](auto change) {
        Motion other = motion;
        change(other);
        return other;
    };
    EXPECT_THROW(analyse(Motion{}), InputError);
    EXPECT_THROW(analyse(changed([](Motion& m) { m.time_s[3] = m.time_s[2]; })), InputError);
    EXPECT_THROW(analyse(changed([&](Motion& m) { m.time_s[3] = nan; })), InputError);
    EXPECT_THROW(analyse(changed([&](Motion& m) { m.positions(5, 4) = nan; })), InputError);
    EXPECT_THROW(analyse(changed([&](Motion& m) { m.positions(5, 4) = HUGE_VAL; })), InputError);
    EXPECT_THROW(analyse(changed([&](Motion& m) { m.positions.setConstant(nan); })), InputError);
}

TEST(Analysis, HoldsTheBoundOnMeasuredSpeech) {
    if (!std::filesystem::exists(kHaskinsCsv)) GTEST_SKIP() << kHaskinsCsv << " is not here";
    const Motion motion = haskins_motion();
    ASSERT_EQ(measured_points(motion.positions, "haskins").size(), 8u);
    const double seconds = motion.time_s.back() - motion.time_s.front();
    double before = static_cast<double>(motion.size());
    for (const double bound : {0.25, 0.5, 1.0, 2.0}) {
        expect_bound_holds(motion, bound);
        const Analysis analysis = analyse_in_full(motion, {bound});
        const double count = static_cast<double>(analysis.track.time_s.size());
        std::printf("haskins_f01 within %.2f mm: %.1f via points a second, rms %.3f mm\n", bound,
                    count / seconds, analysis.rms_error_mm);
        EXPECT_LT(count, before);
        before = count;
    }
    EXPECT_LT(before, static_cast<double>(motion.size()) / 4) << "within 2 mm, noise included";
}

}  // namespace
}  // namespace viaface
