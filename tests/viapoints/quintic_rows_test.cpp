#include "viapoints/quintic_rows.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/viapoints/smooth_motion.hpp"
#include "viapoints/spline.hpp"

namespace viaface {
namespace {

std::vector<double> uneven_times(int count, Dice& dice) {
    std::vector<double> times{3};
    while (std::ssize(times) < count) times.push_back(times.back() + 0.03 + 0.2 * dice.uniform());
    return times;
}

double value_at(const QuinticBasis& basis, const std::vector<double>& controls, int segment, double time) {
    std::vector<QuinticRow> rows;
    basis.append_rows(segment, {&time, 1}, rows);
    double value = 0;
    for (int r = 0; r < kSupport; ++r) {
        const auto control = static_cast<std::size_t>(rows[0].first + r);
        const double weight = rows[0].weight[static_cast<std::size_t>(r)];
        if (control < controls.size())
            value += weight * controls[control];
        else
            EXPECT_EQ(weight, 0);
    }
    return value;
}

TEST(QuinticRows, CombinationsAreTheMinimumJerkSplinesThroughTheirViaPoints) {
    Dice dice(1);
    for (const int count : {3, 4, 5, 6, 7, 20}) {
        const std::vector<double> times = uneven_times(count, dice);
        const QuinticBasis basis(times, true, true);
        std::vector<double> controls;
        for (int i = 0; i < count; ++i) controls.push_back(dice.normal());
        ViaPointTrack track{times, RowMatrix(count, 1)};
        for (int i = 0; i < count; ++i)
            track.points(i, 0) =
                value_at(basis, controls, std::min(i, count - 2), times[static_cast<std::size_t>(i)]);
        const MinimumJerkSpline spline(track);
        for (int segment = 0; segment + 1 < count; ++segment) {
            const auto i = static_cast<std::size_t>(segment);
            for (const double x : {0.1, 0.5, 0.8}) {
                const double time = times[i] + x * (times[i + 1] - times[i]);
                EXPECT_NEAR(value_at(basis, controls, segment, time), spline.at(time)[0], 1e-12);
            }
        }
    }
}

TEST(QuinticRows, APartOfALineGivesTheSameRowsInside) {
    Dice dice(2);
    const std::vector<double> times = uneven_times(24, dice);
    const QuinticBasis whole(times, true, true);
    const std::vector<double> part(times.begin() + 4, times.end() - 4);
    const QuinticBasis inside(part, false, false);
    for (int segment = 4; segment + 6 < std::ssize(part); ++segment) {
        const double time = part[static_cast<std::size_t>(segment)] + 0.01;
        std::vector<QuinticRow> rows, expected;
        inside.append_rows(segment, {&time, 1}, rows);
        whole.append_rows(segment + 4, {&time, 1}, expected);
        EXPECT_EQ(rows[0].first + 4, expected[0].first);
        EXPECT_TRUE(std::ranges::equal(rows[0].weight, expected[0].weight));
    }
}

TEST(QuinticRows, RowsOfManyTimesAreThoseOfEach) {
    Dice dice(4);
    const std::vector<double> times = uneven_times(8, dice);
    const QuinticBasis basis(times, true, true);
    for (int segment = 0; segment < 7; ++segment) {
        const double begin = times[static_cast<std::size_t>(segment)],
                     end = times[static_cast<std::size_t>(segment) + 1];
        std::vector<double> within;
        for (int i = 0; i < 11; ++i) within.push_back(begin + (end - begin) * i / 11);
        std::vector<QuinticRow> together, one_by_one;
        basis.append_rows(segment, within, together);
        for (const double& time : within) basis.append_rows(segment, {&time, 1}, one_by_one);
        ASSERT_EQ(together.size(), within.size());
        for (std::size_t i = 0; i < within.size(); ++i) {
            EXPECT_EQ(together[i].first, one_by_one[i].first);
            EXPECT_TRUE(std::ranges::equal(together[i].weight, one_by_one[i].weight));
        }
    }
}

TEST(QuinticRows, TheJumpIsThatOfTheSplinesFifthDerivative) {
    Dice dice(3);
    const std::vector<double> times = uneven_times(11, dice);
    const QuinticBasis basis(times, true, true);
    std::vector<double> controls;
    for (int i = 0; i < 11; ++i) controls.push_back(dice.normal());
    ViaPointTrack track{times, RowMatrix(11, 1)};
    for (int i = 0; i < 11; ++i)
        track.points(i, 0) = value_at(basis, controls, std::min(i, 9), times[static_cast<std::size_t>(i)]);
    const MinimumJerkSpline spline(track);
    std::array<double, 11> near;
    std::copy(times.begin(), times.end(), near.begin());
    const auto weights = fifth_derivative_jump(near);
    double jump = 0;
    for (std::size_t i = 0; i < 7; ++i) jump += 120 * weights[i] * controls[i + 2];
    const double expected = spline.at(times[5], 5)[0] - spline.at(times[5] - 1e-9, 5)[0];
    EXPECT_NEAR(jump, expected, 1e-6 * std::abs(expected));
}

}  // namespace
}  // namespace viaface
