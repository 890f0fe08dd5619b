// Laws of the learned modes.
#include "lipmodel/modes.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

#include "mouths.hpp"

namespace viaface {
namespace {

using test::Learned;
using test::learned;

Eigen::MatrixXd shapes() {
    const Learned& l = learned();
    const MarkedPoints rest = marked_of(as_column(l.body.mesh.nodes));
    return (l.body.spread * (l.frames.colwise() - rest)).colwise() + as_column(l.body.mesh.nodes);
}

TEST(LipModes, AreTheEigenvectorsOfTheSampleCovariance) {
    const LipModel& m = learned().model;
    const Eigen::MatrixXd all = shapes();
    const Eigen::MatrixXd centred = all.colwise() - all.rowwise().mean();
    const Eigen::MatrixXd covariance = centred * centred.transpose() / (all.cols() - 1);
    const Eigen::MatrixXd image = covariance * m.modes, scaled = m.modes * m.variance.asDiagonal();
    EXPECT_LT((image - scaled).cwiseAbs().maxCoeff(), 1e-8 * m.variance[0]);
    EXPECT_LT(
        (m.modes.transpose() * m.modes - Eigen::MatrixXd::Identity(m.modes.cols(), m.modes.cols())).norm(),
        1e-10);
    EXPECT_NEAR(m.total_variance, covariance.trace(), 1e-9 * m.total_variance);
    EXPECT_LT((lip_shape(m, Eigen::VectorXd::Zero(m.modes.cols())) - all.rowwise().mean()).norm(), 1e-8);
    EXPECT_TRUE(std::is_sorted(m.variance.begin(), m.variance.end(), std::greater<>()));
}

TEST(LipModes, AreAsManyAsTheDataCarry) {
    // The five movements, one of them also squared in effect on none: rank five, whatever is asked for.
    const Learned& l = learned();
    EXPECT_EQ(l.model.modes.cols(), 5);
    EXPECT_EQ(carried_modes(l.body, l.frames, 0.001), 5);
    EXPECT_NEAR(l.model.variance.sum(), l.model.total_variance, 1e-6 * l.model.total_variance);
    EXPECT_LT(l.model.left_over, 1e-6);
}

TEST(LipModes, NoiseBelowTheStatedFloorMakesNoModes) {
    const Learned& l = learned();
    test::Noise noise(8);
    const double sd = 0.05;
    const Eigen::MatrixXd noisy = l.frames + sd * std::sqrt(3.0) * noise.matrix(48, l.frames.cols());
    EXPECT_EQ(carried_modes(l.body, noisy, 2 * sd), 5);
    EXPECT_GT(carried_modes(l.body, noisy, sd / 10),
              20);  // below the true noise, noise is taken for movement
    EXPECT_THROW(learn_lips(l.body, noisy, {.modes = 10, .noise_mm = 100}), std::runtime_error);
}

TEST(LipModes, ShapesOfTrainingAreFoundAgain) {
    const LipModel& m = learned().model;
    const Eigen::MatrixXd all = shapes();
    for (Eigen::Index i = 0; i < all.cols(); i += 29)
        EXPECT_LT((lip_shape(m, lip_modes_of(m, all.col(i))) - all.col(i)).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(LipModes, FewerModesLeaveMoreOver) {
    const LipModel& m = learned().model;
    double before = m.left_over;
    for (int kept = 4; kept >= 1; --kept) {
        const LipModel fewer = with_modes(m, kept);
        EXPECT_EQ(fewer.modes.cols(), kept);
        EXPECT_GT(fewer.left_over, before);
        before = fewer.left_over;
        const LipModel learned_so =
            learn_lips(learned().body, learned().frames, {.modes = kept, .noise_mm = 0.001});
        EXPECT_NEAR(fewer.left_over, learned_so.left_over, 1e-9);
        EXPECT_LT((fewer.modes - learned_so.modes).norm(), 1e-9);
    }
}

TEST(LipModes, LearnedPhysicsSquaredAreTheCovariance) {
    const LipModel& m = learned().model;
    test::Noise noise(9);
    const Eigen::VectorXd f = noise.matrix(LipMesh::kFreedoms, 1);
    const Eigen::VectorXd twice = learned_displacement(m, learned_displacement(m, f));
    const Eigen::VectorXd through_covariance =
        m.modes * (m.variance.asDiagonal() * (m.modes.transpose() * f));
    EXPECT_LT((twice - through_covariance).norm(), 1e-9 * through_covariance.norm());
}

TEST(LipModes, PriorIsAGaussianAndItsGradientItsSlope) {
    const LipModel& m = learned().model;
    test::Noise noise(10);
    const Eigen::VectorXd p = 2 * m.variance.cwiseSqrt().cwiseProduct(noise.matrix(m.variance.size(), 1));
    const Eigen::VectorXd gradient = log_prior_gradient(m, p);
    for (Eigen::Index i = 0; i < p.size(); ++i) {
        const double h = 1e-4 * std::sqrt(m.variance[i]);
        Eigen::VectorXd up = p, down = p;
        up[i] += h;
        down[i] -= h;
        EXPECT_NEAR((log_prior(m, up) - log_prior(m, down)) / (2 * h), gradient[i],
                    1e-7 * std::abs(gradient[i]) + 1e-9);
    }
    // one dimension integrates to one
    const LipModel one = with_modes(m, 1);
    const double sd = std::sqrt(one.variance[0]);
    double integral = 0;
    for (int i = -800; i < 800; ++i)
        integral += std::exp(log_prior(one, Eigen::VectorXd::Constant(1, 0.01 * sd * i))) * 0.01 * sd;
    EXPECT_NEAR(integral, 1, 1e-6);
}

TEST(LipModes, RefuseFramesThatAreNone) {
    const LipBody& body = learned().body;
    EXPECT_THROW(learn_lips(body, Eigen::MatrixXd(48, 0)), std::invalid_argument);
    EXPECT_THROW(learn_lips(body, Eigen::MatrixXd::Constant(48, 3, NAN)), std::invalid_argument);
    EXPECT_THROW(learn_lips(body, test::resting_mouth()), std::runtime_error);  // nothing moves
}

TEST(Modes, FramesLikeAModelTeachItAgain) {
    const LipModel& model = test::learned().model;
    const LipModel again =
        learn_lips(test::learned().body, frames_like(model), {.modes = 48, .noise_mm = model.noise_mm});
    ASSERT_EQ(again.modes.cols(), model.modes.cols());
    EXPECT_LT((again.mean - model.mean).norm(), 1e-6);
    for (Eigen::Index i = 0; i < model.modes.cols(); ++i) {
        EXPECT_NEAR(again.variance[i], model.variance[i], 0.01 * model.variance[i]);
        EXPECT_GT(std::abs(again.modes.col(i).dot(model.modes.col(i))), 0.999);
    }
}

}  // namespace
}  // namespace viaface
