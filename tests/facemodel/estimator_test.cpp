#include "facemodel/estimator.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <limits>
#include <stdexcept>

#include "ensemble.hpp"
#include "facemodel/pca.hpp"

namespace viaface {
namespace {

using test::ensemble;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr int kNodes = 100, kMarkers = 18, kPostures = 8;

// A face whose first 18 nodes are its markers, as in the report ("the values in p are a subset of those in
// f").
struct Trained {
    Eigen::MatrixXd shapes = ensemble(3 * kNodes, kPostures, kPostures - 1, 11);
    Eigen::MatrixXd points = shapes.topRows(3 * kMarkers);
    PrincipalComponents pca = principal_components(shapes);
    Eigen::MatrixXd alphas = pca.all_coefficients(shapes);
};

TEST(LinearEstimator, RecoversEachTrainingPosture) {
    const Trained t;
    const LinearEstimator estimator(t.points, t.alphas);
    for (int k = 0; k < kPostures; ++k) {
        EXPECT_LT((t.pca.shape(estimator.estimate(t.points.col(k))) - t.shapes.col(k)).norm(), 1e-8);
    }
}

TEST(LinearEstimator, RankIsThatOfThePosturesNotOfTheCoordinates) {
    const Trained t;
    const EstimatorFor all = LinearEstimator(t.points, t.alphas).for_presence(Presence(kMarkers, true));
    EXPECT_EQ(all.rank(), kPostures - 1);
    EXPECT_EQ(all.matrix().rows(), kPostures - 1);
    EXPECT_EQ(all.matrix().cols(), 3 * kMarkers);
}

// Three points have 9 coordinates, more than the 7 coefficients.
TEST(LinearEstimator, RecoversPosturesFromThePointsThatArePresent) {
    const Trained t;
    const LinearEstimator estimator(t.points, t.alphas);
    for (int k = 0; k < kPostures; ++k) {
        Eigen::VectorXd some = t.points.col(k);
        for (int point = 0; point < kMarkers; ++point) {
            if (point % 5 != 2) some[3 * point + point % 3] = kNaN;
        }
        EXPECT_LT((t.pca.shape(estimator.estimate(some)) - t.shapes.col(k)).norm(), 1e-6);
    }
}

TEST(LinearEstimator, OnePointGivesTheNearestThatItAllows) {
    const Trained t;
    Eigen::VectorXd one = Eigen::VectorXd::Constant(3 * kMarkers, kNaN);
    one.segment<3>(9) = t.points.col(2).segment<3>(9);
    const EstimatorFor few = LinearEstimator(t.points, t.alphas).for_presence(presence_of(one));
    EXPECT_EQ(few.rank(), 3);
    EXPECT_LT((t.pca.shape(few.estimate(one)).segment<3>(9) - one.segment<3>(9)).norm(), 1e-8);
}

// With noise the estimator is eq. 12 with K sigma^2 on the diagonal, where the inverse exists.
TEST(LinearEstimator, NoiseIsARidgeOnEquationTwelve) {
    const Trained t;
    const double sigma = 0.5;
    const EstimatorFor ours =
        LinearEstimator(t.points, t.alphas, {.noise_mm = sigma}).for_presence(Presence(kMarkers, true));
    const Eigen::MatrixXd p0 = t.points.colwise() - t.points.rowwise().mean();
    const Eigen::MatrixXd ridged =
        p0 * p0.transpose() +
        kPostures * sigma * sigma * Eigen::MatrixXd::Identity(3 * kMarkers, 3 * kMarkers);
    const Eigen::MatrixXd expected = t.alphas * p0.transpose() * ridged.inverse();
    EXPECT_LT((ours.matrix() - expected).norm(), 1e-10 * expected.norm());
}

// An orthogonal projection never lengthens: noise on the points grows no more than the training allows.
TEST(LinearEstimator, ARidgeShrinksTheGain) {
    const Trained t;
    const Presence all(kMarkers, true);
    const double free = LinearEstimator(t.points, t.alphas).for_presence(all).matrix().norm();
    const double little =
        LinearEstimator(t.points, t.alphas, {.noise_mm = 0.1}).for_presence(all).matrix().norm();
    const double more =
        LinearEstimator(t.points, t.alphas, {.noise_mm = 1}).for_presence(all).matrix().norm();
    EXPECT_LT(little, free);
    EXPECT_LT(more, little);
}

TEST(LinearEstimator, TargetsMayHaveAMeanOfTheirOwn) {
    const Trained t;
    const Eigen::MatrixXd contours = t.shapes.bottomRows(120);
    const LinearEstimator estimator(t.points, contours);
    EXPECT_LT((estimator.estimate(t.points.col(5)) - contours.col(5)).norm(), 1e-8);
    EXPECT_LT((estimator.estimate(t.points.rowwise().mean()) - contours.rowwise().mean()).norm(), 1e-9);
}

TEST(LinearEstimator, RefusesWhatDoesNotMatch) {
    const Trained t;
    EXPECT_THROW(LinearEstimator(t.points, t.alphas.leftCols(3)), std::invalid_argument);
    EXPECT_THROW(LinearEstimator(t.points.topRows(7), t.alphas), std::invalid_argument);
    const LinearEstimator estimator(t.points, t.alphas);
    EXPECT_THROW(estimator.estimate(Eigen::VectorXd::Constant(3 * kMarkers, kNaN)), std::invalid_argument);
    EXPECT_THROW(estimator.estimate(Eigen::VectorXd::Zero(9)), std::invalid_argument);
    Eigen::VectorXd partly = t.points.col(0);
    const EstimatorFor all = estimator.for_presence(presence_of(partly));
    partly[4] = kNaN;
    EXPECT_THROW(all.estimate(partly), std::invalid_argument);
}

}  // namespace
}  // namespace viaface
