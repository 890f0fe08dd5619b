#include "viapoints/spline.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <limits>

#include "base/decompositions.hpp"
#include "tests/viapoints/smooth_motion.hpp"
#include "viapoints/hermite.hpp"

namespace viaface {
namespace {

using Eigen::Index;

struct Ends {
    SplineEnd first, last;
};

std::vector<Ends> all_ends(Index dimensions) {
    SplineEnd moving{SplineEnd::Kind::kClamped, Eigen::VectorXd::Constant(dimensions, 3.0),
                     Eigen::VectorXd::Constant(dimensions, -20.0)};
    const SplineEnd natural = SplineEnd::natural(), rest = SplineEnd::at_rest();
    return {{natural, natural}, {natural, rest}, {rest, natural}, {moving, rest}, {natural, moving}};
}

ViaPointTrack random_track(std::uint64_t seed, std::size_t count, Index dimensions, double widest_ratio = 4) {
    Dice dice(seed);
    ViaPointTrack track{{}, RowMatrix(static_cast<Index>(count), dimensions)};
    double t = -0.3;
    for (std::size_t i = 0; i < count; ++i) {
        track.time_s.push_back(t);
        t += 0.02 * std::pow(widest_ratio, dice.uniform());
        for (Index d = 0; d < dimensions; ++d) track.points(static_cast<Index>(i), d) = 10 * dice.normal();
    }
    return track;
}

double before(double t) { return std::nextafter(t, -std::numeric_limits<double>::infinity()); }

TEST(Spline, PassesThroughEveryViaPointExactly) {
    for (const std::size_t count : {2u, 3u, 4u, 60u}) {
        for (const Ends& ends : all_ends(3)) {
            const ViaPointTrack track = random_track(count, count, 3);
            const MinimumJerkSpline spline(track, ends.first, ends.last);
            EXPECT_EQ(spline.at(track.time_s), track.points);
        }
    }
}

// Derivatives on the two sides of a via point, relative to the largest of their kind: rounding of a system
// whose scaled condition number stays under 50, times the five powers of the gap that a fourth derivative
// divides by.
TEST(Spline, IsFourTimesContinuouslyDifferentiableAtEveryViaPoint) {
    for (const Ends& ends : all_ends(2)) {
        const ViaPointTrack track = random_track(7, 40, 2);
        const MinimumJerkSpline spline(track, ends.first, ends.last);
        for (int derivative = 0; derivative <= 4; ++derivative) {
            const double largest = spline.at(track.time_s, derivative).cwiseAbs().maxCoeff();
            for (std::size_t i = 1; i + 1 < track.time_s.size(); ++i) {
                const double t = track.time_s[i];
                const double jump =
                    (spline.at(t, derivative) - spline.at(before(t), derivative)).cwiseAbs().maxCoeff();
                EXPECT_LT(jump, 1e-9 * largest) << "derivative " << derivative << " at via point " << i;
            }
        }
        const double t = track.time_s[20];
        EXPECT_GT((spline.at(t, 5) - spline.at(before(t), 5)).cwiseAbs().maxCoeff(), 1.0)
            << "the fifth must jump";
    }
}

TEST(Spline, MeetsItsEndConditions) {
    for (const std::size_t count : {2u, 3u, 30u}) {
        for (const Ends& ends : all_ends(2)) {
            const ViaPointTrack track = random_track(11, count, 2);
            const MinimumJerkSpline spline(track, ends.first, ends.last);
            const auto holds = [&](const SplineEnd& end, double t) {
                const bool clamped = end.kind == SplineEnd::Kind::kClamped;
                for (const int derivative : clamped ? std::vector{1, 2} : std::vector{3, 4}) {
                    Eigen::VectorXd expected = Eigen::VectorXd::Zero(2);
                    if (clamped && end.velocity.size())
                        expected = derivative == 1 ? end.velocity : end.acceleration;
                    // rounding of the terms, which are as large as points over powers of the shortest gap
                    const double largest = track.points.cwiseAbs().maxCoeff() / std::pow(0.02, derivative);
                    EXPECT_LT((spline.at(t, derivative) - expected).cwiseAbs().maxCoeff(), 1e-11 * largest)
                        << "derivative " << derivative << " at " << t << " of " << count;
                }
            };
            holds(ends.first, track.time_s.front());
            holds(ends.last, track.time_s.back());
        }
    }
}

// The cost as a quadratic in all free v, a (positions fixed), minimised densely with no use of the spline's
// own equations.
double brute_force_cost(const ViaPointTrack& track, const MinimumJerkSystem::Derivatives* start = nullptr) {
    const std::size_t n = track.time_s.size();
    const auto cost = [&](const Eigen::VectorXd& u) {  // u: v0 a0 v1 a1 ...
        double sum = 0;
        for (std::size_t i = 0; i + 1 < n; ++i) {
            const double h = track.time_s[i + 1] - track.time_s[i];
            const auto jerk = [&](double x) {
                const HermiteWeights w = hermite_weights(h, x, 3);
                const auto k = static_cast<Index>(2 * i);
                return w.p0 * track.points(k / 2, 0) + w.v0 * u[k] + w.a0 * u[k + 1] +
                       w.p1 * track.points(k / 2 + 1, 0) + w.v1 * u[k + 2] + w.a1 * u[k + 3];
            };
            const double g = std::sqrt(0.6) / 2;  // Gauss-Legendre, exact to the fifth power
            const double left = jerk(0.5 - g), middle = jerk(0.5), right = jerk(0.5 + g);
            sum += h / 2 * (5 * left * left + 8 * middle * middle + 5 * right * right) / 18;
        }
        return sum;
    };
    const auto size = static_cast<Index>(2 * n);
    if (start) {
        Eigen::VectorXd u(size);
        for (Index i = 0; i < size; ++i) u[i] = (i % 2 ? start->acceleration : start->velocity)(i / 2, 0);
        return cost(u);
    }
    const Eigen::VectorXd zero = Eigen::VectorXd::Zero(size);
    const auto unit = [&](Index i) { return Eigen::VectorXd(Eigen::VectorXd::Unit(size, i)); };
    Eigen::MatrixXd hessian(size, size);
    Eigen::VectorXd gradient(size);
    for (Index i = 0; i < size; ++i) {
        gradient[i] = (cost(unit(i)) - cost(-unit(i))) / 2;
        for (Index j = 0; j < size; ++j) {
            hessian(i, j) = (cost(unit(i) + unit(j)) - cost(unit(i) - unit(j)) - cost(unit(j) - unit(i)) +
                             cost(-unit(i) - unit(j))) /
                            4;
            if (i == j) hessian(i, i) = (cost(2 * unit(i)) + cost(-2 * unit(i)) - 2 * cost(zero)) / 4;
        }
    }
    return cost(-solve_positive(hessian, gradient));
}

// Gaps of one second keep the dense problem well conditioned.
TEST(Spline, CostsWhatBruteForceMinimisationFinds) {
    ViaPointTrack track{{0, 1, 1.8, 3.1, 4, 5.5}, RowMatrix(6, 1)};
    track.points << 0.3, -1, 2, 2.5, -0.7, 1;
    const MinimumJerkSpline spline(track);
    const double best = brute_force_cost(track);
    EXPECT_NEAR(spline.jerk_cost(), best, 1e-8 * best);
    const MinimumJerkSystem::Derivatives own{spline.velocity(), spline.acceleration()};
    EXPECT_NEAR(brute_force_cost(track, &own), spline.jerk_cost(), 1e-10 * best);
}

TEST(Spline, NoChangeOfVelocityOrAccelerationLowersTheJerk) {
    const ViaPointTrack track = random_track(3, 12, 1);
    const MinimumJerkSpline spline(track);
    const double cost = spline.jerk_cost();
    for (Index i = 0; i < 12; ++i) {
        for (const double sign : {-1.0, 1.0}) {
            MinimumJerkSystem::Derivatives moved{spline.velocity(), spline.acceleration()};
            moved.velocity(i, 0) += sign * 20;
            EXPECT_GT(brute_force_cost(track, &moved), cost);
            moved = {spline.velocity(), spline.acceleration()};
            moved.acceleration(i, 0) += sign * 1000;
            EXPECT_GT(brute_force_cost(track, &moved), cost);
        }
    }
}

// x + e b, b = s^p prod (t - t_i) vanishing at every via point: J(x + e b) - J(x) = e <x''', b'''> + e^2
// J(b), and at the minimum <x''', b'''> is zero. Integrated by Gauss-Legendre in each segment, exact for the
// polynomials at hand.
TEST(Spline, JerkIsOrthogonalToThatOfBumpsThatVanishAtViaPoints) {
    const ViaPointTrack track{{0, 0.5, 1.1, 2}, (RowMatrix(4, 1) << 1, -2, 0.5, 3).finished()};
    const MinimumJerkSpline spline(track);
    for (int power = 0; power <= 3; ++power) {
        std::vector<double> bump{1};  // coefficients, lowest first
        const auto times = [&](double root) {
            std::vector<double> product(bump.size() + 1, 0.0);
            for (std::size_t k = 0; k < bump.size(); ++k) {
                product[k + 1] += bump[k];
                product[k] -= root * bump[k];
            }
            bump = product;
        };
        for (const double t : track.time_s) times(t);
        for (int p = 0; p < power; ++p) times(-0.7);
        double inner = 0, size = 0;
        for (std::size_t i = 0; i + 1 < track.time_s.size(); ++i) {
            const double h = track.time_s[i + 1] - track.time_s[i];
            constexpr double kNode[] = {-0.9061798459386640, -0.5384693101056831, 0, 0.5384693101056831,
                                        0.9061798459386640};
            constexpr double kWeight[] = {0.2369268850561891, 0.4786286704993665, 0.5688888888888889,
                                          0.4786286704993665, 0.2369268850561891};
            for (int g = 0; g < 5; ++g) {
                const double t = track.time_s[i] + h * (1 + kNode[g]) / 2;
                double third = 0;
                for (std::size_t k = 3; k < bump.size(); ++k) {
                    third += bump[k] * static_cast<double>(k * (k - 1) * (k - 2)) *
                             std::pow(t, static_cast<double>(k - 3));
                }
                inner += h / 2 * kWeight[g] * third * spline.at(t, 3)[0];
                size += h / 2 * kWeight[g] * std::abs(third * spline.at(t, 3)[0]);
            }
        }
        EXPECT_GT(size, 1);
        EXPECT_LT(std::abs(inner), 1e-11 * size) << "power " << power;
    }
}

TEST(Spline, OneStrokeFromRestToRestIsTheClosedForm) {
    const ViaPointTrack track{{2.0, 2.2}, (RowMatrix(2, 1) << 5, 17).finished()};
    const MinimumJerkSpline spline(track, SplineEnd::at_rest(), SplineEnd::at_rest());
    double peak = 0;
    for (int i = 0; i <= 1000; ++i) {
        const double x = i / 1000.0, t = 2.0 + 0.2 * x;
        EXPECT_NEAR(spline.at(t)[0], 5 + 12 * x * x * x * (10 - 15 * x + 6 * x * x), 1e-11);
        peak = std::max(peak, spline.at(t, 1)[0]);
    }
    EXPECT_NEAR(peak / (12 / 0.2), 1.875, 1e-10);
    EXPECT_NEAR(spline.jerk_cost(), 360 * 12 * 12 / std::pow(0.2, 5), 1e-4);  // 1/2 * 720 d^2 / h^5
}

// The minimiser reproduces what costs nothing: a parabola, whatever the gaps. Natural ends hold for it
// exactly.
TEST(Spline, GapRatiosOfThreeHundredToOneAreSolvedToRounding) {
    Dice dice(5);
    ViaPointTrack track{{}, RowMatrix(100, 1)};
    double t = 0;
    for (Index i = 0; i < 100; ++i) {
        track.time_s.push_back(t);
        track.points(i, 0) = 40 - 30 * t + 12 * t * t;
        t += i % 3 == 0 ? 0.3 : 0.001 * (1 + dice.uniform());
    }
    const MinimumJerkSpline spline(track);
    for (Index i = 0; i < 100; ++i) {
        const double s = track.time_s[static_cast<std::size_t>(i)];
        EXPECT_NEAR(spline.velocity()(i, 0), -30 + 24 * s,
                    1e-7);  // rounding of positions over a gap: 1e-14 mm / 1e-3 s
    }
    for (double s = 0; s < t - 0.4; s += 0.0123) EXPECT_NEAR(spline.at(s)[0], 40 - 30 * s + 12 * s * s, 1e-9);
}

// Two natural ends leave the bend of a parabola free, at no cost.
TEST(Spline, TwoViaPointsWithNaturalEndsAreJoinedByAStraightLine) {
    const MinimumJerkSpline spline({{1, 3}, (RowMatrix(2, 1) << 5, 9).finished()});
    EXPECT_DOUBLE_EQ(spline.at(1.5)[0], 6);
    EXPECT_NEAR(spline.jerk_cost(), 0, 1e-20);
}

TEST(Spline, OutsideItsSpanTheEndsAreHeld) {
    const ViaPointTrack track = random_track(2, 5, 2);
    const MinimumJerkSpline spline(track);
    EXPECT_EQ(spline.at(-100), track.points.row(0).transpose());
    EXPECT_EQ(spline.at(100), track.points.row(4).transpose());
    for (int derivative = 1; derivative <= 5; ++derivative) EXPECT_TRUE(spline.at(100, derivative).isZero(0));
}

TEST(Spline, OneSweepEqualsOneByOne) {
    const ViaPointTrack track = random_track(9, 30, 4);
    const MinimumJerkSpline spline(track);
    std::vector<double> times;
    for (double t = -0.5; t < track.time_s.back() + 0.2; t += 0.007) times.push_back(t);
    const RowMatrix sweep = spline.at(times);
    for (std::size_t i = 0; i < times.size(); ++i) {
        EXPECT_EQ(sweep.row(static_cast<Index>(i)).transpose(), spline.at(times[i]));
    }
}

TEST(Spline, ColumnsDoNotMix) {
    ViaPointTrack track = random_track(4, 10, 3);
    const MinimumJerkSpline whole(track);
    track.points.col(1).setConstant(std::numeric_limits<double>::quiet_NaN());
    const MinimumJerkSpline holed(track);
    for (const double t : {-0.5, -0.2, 0.0, 0.1}) {
        EXPECT_EQ(holed.at(t)[0], whole.at(t)[0]);
        EXPECT_EQ(holed.at(t)[2], whole.at(t)[2]);
        EXPECT_TRUE(std::isnan(holed.at(t)[1]));
    }
    EXPECT_GT(holed.jerk_cost(), 0);
}

TEST(Spline, RubbishIsRefused) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto points = [](Index n) { return RowMatrix(RowMatrix::Zero(n, 2)); };
    EXPECT_THROW(MinimumJerkSpline({{0}, points(1)}), std::invalid_argument);
    EXPECT_THROW(MinimumJerkSpline({{0, 0}, points(2)}), std::invalid_argument);
    EXPECT_THROW(MinimumJerkSpline({{0, nan}, points(2)}), std::invalid_argument);
    EXPECT_THROW(MinimumJerkSpline({{0, 1}, points(3)}), std::invalid_argument);
    SplineEnd wrong = SplineEnd::at_rest();
    wrong.velocity = Eigen::VectorXd::Zero(3);
    EXPECT_THROW(MinimumJerkSpline({{0, 1}, points(2)}, wrong), std::invalid_argument);
    const MinimumJerkSpline spline({{0, 1}, points(2)});
    EXPECT_THROW(spline.at(0.5, 6), std::invalid_argument);
    EXPECT_THROW(spline.at(nan), std::invalid_argument);
    EXPECT_THROW(spline.at({0.5, 0.4}), std::invalid_argument);
}

}  // namespace
}  // namespace viaface
