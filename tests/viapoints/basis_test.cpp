#include "viapoints/basis.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "base/error.hpp"
#include "tests/viapoints/smooth_motion.hpp"
#include "viapoints/measured.hpp"

namespace viaface {
namespace {

using Eigen::Index;

constexpr int kSources = 5;

RowMatrix configurations(std::uint64_t seed, int points = kPoints) {
    return smooth_motion(seed, 4, 50, points, kSources).positions;
}

TEST(Basis, ModesAreOrthonormalOrderedAndHaveAPositivePeak) {
    const RowMatrix training = configurations(1);
    const ConfigurationBasis basis = principal_basis(training, kCoordinates);
    ASSERT_EQ(basis.size(), kSources) << "the training's rank";
    const Eigen::MatrixXd gram = basis.modes.transpose() * basis.modes;
    EXPECT_LT((gram - Eigen::MatrixXd::Identity(kSources, kSources)).cwiseAbs().maxCoeff(), 1e-12);
    const RowMatrix components = to_components(basis, training);
    EXPECT_LT(components.colwise().mean().cwiseAbs().maxCoeff(), 1e-10);
    const Eigen::MatrixXd covariance = components.transpose() * components;
    for (Index k = 0; k < kSources; ++k) {
        Index peak = 0;
        basis.modes.col(k).cwiseAbs().maxCoeff(&peak);
        EXPECT_GT(basis.modes(peak, k), 0);
        for (Index j = 0; j < k; ++j) {
            EXPECT_GT(covariance(j, j), covariance(k, k));
            EXPECT_LT(std::abs(covariance(j, k)), 1e-9 * covariance(0, 0));
        }
    }
}

TEST(Basis, FullRankRoundTrips) {
    const RowMatrix training = configurations(2);
    const ConfigurationBasis basis = principal_basis(training, kCoordinates);
    EXPECT_LT((to_points(basis, to_components(basis, training)) - training).cwiseAbs().maxCoeff(), 1e-10);
    const RowMatrix components = RowMatrix::Identity(kSources, kSources) * 7;
    EXPECT_LT((to_components(basis, to_points(basis, components)) - components).cwiseAbs().maxCoeff(), 1e-10);
}

TEST(Basis, TheOrderAndTheSignOfTheTrainingDoNotMatter) {
    const RowMatrix training = configurations(3);
    const ConfigurationBasis one = principal_basis(training, 3),
                             other = principal_basis(training.colwise().reverse(), 3);
    EXPECT_LT((one.modes - other.modes).cwiseAbs().maxCoeff(), 1e-9);
    const RowMatrix mirrored = (-training).rowwise() + 2 * training.colwise().mean();
    EXPECT_LT((one.modes - principal_basis(mirrored, 3).modes).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(Basis, TheFewestModesWithinTheBoundAreChosen) {
    const Motion equal = smooth_motion(4, 8, 50, kPoints, 12);
    const ConfigurationBasis mixed = principal_basis(equal.positions, 12);
    RowMatrix components = to_components(mixed, equal.positions);
    for (Index k = 0; k < 12; ++k) components.col(k) *= std::pow(0.35, static_cast<double>(k));
    const RowMatrix positions = to_points(mixed, components);
    const RowMatrix training = positions.topRows(200), held_out = positions.bottomRows(201);
    Index before = kCoordinates;
    for (const double bound : {0.01, 0.1, 1.0, 5.0}) {
        const ConfigurationBasis basis = choose_basis(training, held_out, bound);
        EXPECT_LE(truncation_error_mm(basis, held_out), bound);
        EXPECT_GT(truncation_error_mm(principal_basis(training, basis.size() - 1), held_out), bound);
        EXPECT_LT(basis.size(), before);
        before = basis.size();
    }
}

TEST(Basis, AnErrorThatAllModesLeaveIsNamed) {
    RowMatrix held_out = configurations(5);
    held_out(7, 30) += 3;
    try {
        choose_basis(configurations(5), held_out, 0.1);
        FAIL();
    } catch (const InputError& error) {
        EXPECT_EQ(error.field(), "max_error_mm");
        EXPECT_NE(error.allowed().find("at least 2."), std::string::npos) << error.allowed();
    }
}

TEST(Basis, PointsThatWereNeverMeasuredStayMissing) {
    const RowMatrix training = configurations(6, 8);
    const ConfigurationBasis basis = principal_basis(training, kCoordinates);
    EXPECT_EQ(points_of(basis).size(), 8u);
    const RowMatrix points = to_points(basis, to_components(basis, training));
    EXPECT_LT((points.leftCols(24) - training.leftCols(24)).cwiseAbs().maxCoeff(), 1e-10);
    EXPECT_TRUE(points.rightCols(kCoordinates - 24).array().isNaN().all());
    EXPECT_LT(truncation_error_mm(basis, training), 1e-10);
    EXPECT_THROW(to_components(basis, configurations(6, 7)), std::invalid_argument);
}

TEST(Basis, GapsAreRefusedByName) {
    RowMatrix training = configurations(7);
    training(3, 3 * kChin + 1) = std::numeric_limits<double>::quiet_NaN();
    try {
        principal_basis(training, 4);
        FAIL();
    } catch (const InputError& error) {
        EXPECT_EQ(error.value(), "chin at sample 3");
    }
    EXPECT_THROW(principal_basis(RowMatrix(0, kCoordinates), 4), InputError);
    EXPECT_THROW(principal_basis(RowMatrix::Zero(3, 5), 4), std::invalid_argument);
}

TEST(Basis, OneConfigurationIsItsOwnMean) {
    const RowMatrix one = configurations(8).topRows(1);
    const ConfigurationBasis basis = principal_basis(one, 10);
    EXPECT_EQ(basis.size(), 0);
    EXPECT_EQ(truncation_error_mm(basis, one), 0);
}

}  // namespace
}  // namespace viaface
