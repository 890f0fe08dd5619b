#include "lipmodel/reconstruction.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "base/decompositions.hpp"
#include "mouths.hpp"

namespace viaface {
namespace {

using test::Learned;
using test::learned;

TEST(Reconstruction, EachViewSeesTwoOfThreeCoordinates) {
    for (const LipView view : {LipView::kFrontal, LipView::kProfile}) {
        const auto seen = coordinates_seen(view);
        EXPECT_EQ(seen.size(), 32u);
        for (const int c : seen) EXPECT_NE(c % 3, view == LipView::kFrontal ? 2 : 0);
    }
}

TEST(Reconstruction, WhatIsNotSeenIsNotLookedAt) {
    const Learned& l = learned();
    const ModeEstimator frontal(l.model, coordinates_seen(LipView::kFrontal), 0.01);
    Eigen::MatrixXd blind = l.frames.leftCols(5);
    for (int i = 2; i < 48; i += 3) blind.row(i).setConstant(NAN);
    EXPECT_EQ(frontal.modes(blind), frontal.modes(l.frames.leftCols(5)));
}

TEST(Reconstruction, FindsAgainWhatTheViewShows) {
    // The made-up mouth protrudes along z alone: the profile shows every movement, the front all but this.
    const Learned& l = learned();
    const ReconstructionError profile = reconstruction_errors(l.body, l.model, l.frames).profile;
    EXPECT_LT(std::sqrt(profile.mesh), 0.05);
    EXPECT_LT(std::sqrt(profile.points), 0.05);
    const auto seen = coordinates_seen(LipView::kFrontal);
    const Eigen::MatrixXd p = ModeEstimator(l.model, seen, 1e-6).modes(l.frames);
    double depth = 0;
    for (Eigen::Index i = 0; i < p.cols(); ++i) {
        const MarkedPoints off = marked_of(lip_shape(l.model, p.col(i))) - MarkedPoints(l.frames.col(i));
        EXPECT_LT(Eigen::VectorXd(off)(seen).cwiseAbs().maxCoeff(), 0.05);
        depth += off.squaredNorm();
    }
    EXPECT_GT(std::sqrt(depth / static_cast<double>(l.frames.size())), 0.5);
}

TEST(Reconstruction, IsTheMostProbable) {
    const Learned& l = learned();
    const auto seen = coordinates_seen(LipView::kFrontal);
    const double variance = 0.3;
    const Eigen::VectorXd frame = l.frames.col(17);
    const Eigen::VectorXd best = ModeEstimator(l.model, seen, variance).modes(frame);
    const auto posterior = [&](const Eigen::VectorXd& p) {
        const Eigen::VectorXd off = marked_of(lip_shape(l.model, p)) - frame;
        return log_prior(l.model, p) - 0.5 * off(seen).squaredNorm() / variance;
    };
    test::Noise noise(11);
    for (int i = 0; i < 50; ++i)
        EXPECT_GT(posterior(best), posterior(best + 0.1 * noise.matrix(best.size(), 1)));
}

TEST(Reconstruction, WithoutNoiseItIsLeastForceUnderTheLearnedPhysics) {
    // Fewer observations than modes: eqs. 2-4 with the learned K^-1 in place of the first one.
    const Learned& l = learned();
    const std::vector<int> seen = {2, 3, 13, 14};  // the made-up movements show in each of them otherwise
    const auto marked = marked_nodes();
    Eigen::MatrixXd p_rows(seen.size(), LipMesh::kFreedoms);
    for (std::size_t i = 0; i < seen.size(); ++i) {
        const int freedom = 3 * marked[seen[i] / 3] + seen[i] % 3;
        p_rows.row(i) = learned_displacement(l.model, Eigen::VectorXd::Unit(LipMesh::kFreedoms, freedom));
    }
    const MarkedPoints centre = marked_of(lip_shape(l.model, Eigen::VectorXd::Zero(l.model.modes.cols())));
    const Eigen::VectorXd goal = (l.frames.col(40) - centre)(seen);
    const Eigen::VectorXd force = least_squares(p_rows, goal);
    const Eigen::VectorXd p = ModeEstimator(l.model, seen, 1e-10).modes(l.frames.col(40));
    EXPECT_LT((l.model.modes * p - learned_displacement(l.model, force)).cwiseAbs().maxCoeff(), 1e-5);
}

TEST(Reconstruction, CrossValidationTriesFramesItHasNotSeen) {
    const Learned& l = learned();
    // A last stretch with a movement of its own: seen in training it is reconstructed, left out it is not.
    Eigen::MatrixXd frames = l.frames;
    for (int i = 2; i < 48; i += 3) frames.row(i).tail(30).array() += i < 24 ? 3 : -3;
    const LipTraining training{.modes = 10, .noise_mm = 0.001};
    const auto left_out = cross_validated(l.body, frames, training);
    const double seen =
        reconstruction_errors(l.body, learn_lips(l.body, frames, training), frames).profile.points;
    EXPECT_LT(seen, 0.01);
    ASSERT_EQ(left_out.size(), 5u);  // the other stretches carry five
    EXPECT_GT(left_out.back().profile.points, 10 * seen);
    EXPECT_GT(left_out.front().frontal.points, left_out.back().frontal.points);
    EXPECT_THROW(cross_validated(l.body, frames.leftCols(10), training), std::invalid_argument);
}

TEST(Reconstruction, FewModesAreRobustAndManyAccurate) {
    const Learned& l = learned();
    test::Noise noise(12);
    const auto error = [&](int modes, double noise_mm) {
        const LipModel model = with_modes(l.model, modes);
        test::Noise same(12);
        const Eigen::MatrixXd seen = l.frames + noise_mm * same.matrix(48, l.frames.cols());
        const Eigen::MatrixXd p = ModeEstimator(model, coordinates_seen(LipView::kProfile), 0).modes(seen);
        double sum = 0;
        for (Eigen::Index i = 0; i < p.cols(); ++i)
            sum += (marked_of(lip_shape(model, p.col(i))) - l.frames.col(i)).squaredNorm();
        return sum / static_cast<double>(l.frames.size());
    };
    EXPECT_LT(error(5, 0), error(2, 0));
    EXPECT_LT(error(2, 12), error(5, 12));
}

TEST(Reconstruction, PaperUnitsScaleTheMeshUniformly) {
    const Nodes rest = learned().body.mesh.nodes;
    EXPECT_NEAR(in_paper_units(1, rest), std::pow(2.83 / largest_extent(rest), 2), 1e-12);
    EXPECT_NEAR(in_paper_units(4, 2 * rest), in_paper_units(1, rest), 1e-12);
}

}  // namespace
}  // namespace viaface
