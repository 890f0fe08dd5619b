// Lips shut as a model of their own.
#include "lipmodel/closed_lips.hpp"

#include <gtest/gtest.h>

#include "mouths.hpp"

namespace viaface {
namespace {

const LipModel& model() { return test::learned().model; }

double quadratic(const LipModel& of, const Eigen::VectorXd& p) {
    return 0.5 * p.cwiseAbs2().cwiseQuotient(of.variance).sum();
}

Eigen::VectorXd some_modes(const LipModel& of, test::Noise& noise) {
    return of.variance.cwiseSqrt().cwiseProduct(noise.matrix(of.variance.size(), 1));
}

TEST(ClosedLips, AreShutWhateverTheirModes) {
    const ClosedLips closed = closed_lips(model());
    ASSERT_GT(closed.model.modes.cols(), 0);
    ASSERT_LT(closed.model.modes.cols(), model().modes.cols());
    test::Noise noise(3);
    EXPECT_GT(marked_openings(lip_shape(model(), some_modes(model(), noise))).norm(), 0.5);
    for (int i = 0; i < 20; ++i) {
        const Eigen::VectorXd q = some_modes(closed.model, noise);
        EXPECT_LT(marked_openings(lip_shape(closed.model, q)).norm(), 1e-6);  // mm
        EXPECT_LT((lip_shape(closed.model, q) - lip_shape(model(), closed.modes_of(q))).norm(), 1e-9);
        EXPECT_LT((closed.nearest(closed.modes_of(q)) - q).norm(), 1e-9);
    }
}

TEST(ClosedLips, PriorIsTheModelsOwn) {
    const ClosedLips closed = closed_lips(model());
    const Eigen::MatrixXd gram = closed.turn.transpose() * closed.turn;
    EXPECT_LT((gram - Eigen::MatrixXd::Identity(gram.rows(), gram.cols())).norm(), 1e-9);
    test::Noise noise(4);
    for (int i = 0; i < 20; ++i) {
        const Eigen::VectorXd q = some_modes(closed.model, noise);
        const double whole = quadratic(model(), closed.modes_of(q));
        EXPECT_NEAR(whole, quadratic(closed.model, q) + closed.cost, 1e-6 * (1 + whole));
    }
}

TEST(ClosedLips, LipsThatNeverOpenAreShutAtTheirMean) {
    const Eigen::MatrixXd frames = test::speaking_mouth(40);
    Eigen::MatrixXd moved = frames.col(0).replicate(1, 30);  // shut, and moving along x alone
    test::Noise noise(5);
    for (Eigen::Index n = 0; n < moved.cols(); ++n) {
        const double step = noise();
        for (int i = 0; i < LipMesh::kMarked; ++i) moved(3 * i, n) += step;
    }
    const LipModel still = learn_lips(test::learned().body, moved, {.noise_mm = 0.01});
    const ClosedLips closed = closed_lips(still);
    EXPECT_EQ(closed.model.modes.cols(), still.modes.cols());
    EXPECT_LT(closed.at.norm(), 1e-3);
}

}  // namespace
}  // namespace viaface
