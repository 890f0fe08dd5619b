#include "facemodel/pca.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "ensemble.hpp"

namespace viaface {
namespace {

using test::ensemble;
constexpr double kRoundOff =
    1e-9;  // mm: 1e-16 relative of 100 mm, summed over a few hundred terms, and slack

TEST(PrincipalComponents, ModesAreOrthonormalAndOrdered) {
    const PrincipalComponents pca = principal_components(ensemble(300, 8, 7, 1));
    ASSERT_EQ(pca.modes.cols(), 7);
    const Eigen::MatrixXd gram = pca.modes.transpose() * pca.modes;
    EXPECT_LT((gram - Eigen::MatrixXd::Identity(7, 7)).cwiseAbs().maxCoeff(), 1e-12);
    for (int i = 1; i < 7; ++i) EXPECT_LE(pca.variance[i], pca.variance[i - 1]);
    EXPECT_GT(pca.variance[6], 0);
}

TEST(PrincipalComponents, TheyAreEigenvectorsOfTheCovariance) {
    const Eigen::MatrixXd shapes = ensemble(60, 9, 4, 2);
    const PrincipalComponents pca = principal_components(shapes);
    const Eigen::MatrixXd deviations = shapes.colwise() - shapes.rowwise().mean();
    const Eigen::MatrixXd covariance = deviations * deviations.transpose() / 9;
    for (int i = 0; i < pca.modes.cols(); ++i) {
        EXPECT_LT((covariance * pca.modes.col(i) - pca.variance[i] * pca.modes.col(i)).norm(),
                  1e-12 * covariance.norm());
    }
    EXPECT_NEAR(pca.total_variance, covariance.trace(), 1e-12 * covariance.trace());
    EXPECT_NEAR(pca.share().sum(), 1, 1e-12);
}

TEST(PrincipalComponents, EveryShapeOfTheEnsembleRoundTrips) {
    const Eigen::MatrixXd shapes = ensemble(300, 8, 7, 3);
    const PrincipalComponents pca = principal_components(shapes);
    for (int k = 0; k < shapes.cols(); ++k) {
        EXPECT_LT((pca.shape(pca.coefficients(shapes.col(k))) - shapes.col(k)).norm(), kRoundOff);
        EXPECT_LT((pca.all_coefficients(shapes).col(k) - pca.coefficients(shapes.col(k))).norm(), kRoundOff);
    }
}

TEST(PrincipalComponents, EightShapesHaveAtMostSevenModes) {
    EXPECT_EQ(principal_components(ensemble(300, 8, 8, 4)).modes.cols(), 7);
    EXPECT_EQ(principal_components(ensemble(300, 8, 3, 4)).modes.cols(), 3);
    EXPECT_EQ(principal_components(ensemble(300, 1, 1, 4)).modes.cols(), 0);
    EXPECT_EQ(principal_components(ensemble(300, 1, 1, 4).replicate(1, 5)).modes.cols(), 0);
}

TEST(PrincipalComponents, ACapKeepsTheLargest) {
    const Eigen::MatrixXd shapes = ensemble(300, 8, 7, 5);
    const PrincipalComponents all = principal_components(shapes), five = principal_components(shapes, 5);
    ASSERT_EQ(five.modes.cols(), 5);
    EXPECT_EQ(five.modes, all.modes.leftCols(5));
    EXPECT_EQ(five.total_variance, all.total_variance);
    EXPECT_LT(five.share().sum(), 1);
}

TEST(PrincipalComponents, SignsDoNotDependOnTheOrderOfShapes) {
    const Eigen::MatrixXd shapes = ensemble(300, 6, 5, 6);
    const PrincipalComponents forward = principal_components(shapes);
    const PrincipalComponents backward = principal_components(shapes.rowwise().reverse());
    EXPECT_LT((forward.modes - backward.modes).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(PrincipalComponents, RefusesWhatIsNotAnEnsemble) {
    EXPECT_THROW(principal_components(Eigen::MatrixXd(3, 0)), std::invalid_argument);
    Eigen::MatrixXd shapes = ensemble(30, 4, 3, 7);
    const PrincipalComponents pca = principal_components(shapes);
    EXPECT_THROW(pca.coefficients(Eigen::VectorXd::Zero(29)), std::invalid_argument);
    EXPECT_THROW(pca.shape(Eigen::VectorXd::Zero(5)), std::invalid_argument);
    shapes(3, 2) = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(principal_components(shapes), std::invalid_argument);
}

}  // namespace
}  // namespace viaface
