#include "viapoints/stream_blends.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/viapoints/smooth_motion.hpp"
#include "viapoints/measured.hpp"
#include "viapoints/stream_basis.hpp"
#include "viapoints/stream_choice.hpp"
#include "viapoints/stream_train.hpp"
#include "viapoints/via_stream.hpp"

namespace viaface {
namespace {

constexpr int kHeldPoints = 4;

std::vector<int> held_points() { return {0, 1, 2, 3}; }

// Each mode moves one coordinate.
ConfigurationBasis axes(int modes) {
    ConfigurationBasis basis{Configuration::Constant(std::nan("")),
                             Eigen::MatrixXd::Identity(kCoordinates, modes)};
    basis.mean.head(3 * kHeldPoints).setZero();
    return basis;
}

// Every coordinate in proportion to `weights`, times a wave.
Motion along(const Eigen::VectorXd& weights, double seconds) {
    Motion motion;
    const auto samples = static_cast<Eigen::Index>(30 * seconds);
    motion.positions = RowMatrix::Constant(samples, kCoordinates, std::nan(""));
    for (Eigen::Index i = 0; i < samples; ++i) {
        const double t = static_cast<double>(i) / 30;
        motion.time_s.push_back(t);
        motion.positions.row(i).head(weights.size()) = 10 * std::sin(9 * t) * weights.transpose();
    }
    return motion;
}

Eigen::VectorXd slanted() {
    Eigen::VectorXd weights(3 * kHeldPoints);
    weights << 0, 0, 1, -4, 2, 0, 4, -7, 2, 0, 1, 4;
    weights /= 7;
    return weights;
}

TEST(StreamBlends, AreReadAsTheyWereWritten) {
    Dice dice(1);
    for (int n = 0; n < 50; ++n) {
        const int modes = static_cast<int>(60 * dice.uniform()),
                  blends = static_cast<int>(9 * dice.uniform());
        BlendWeights weights = BlendWeights::NullaryExpr(modes, blends, [&] {
            return static_cast<int>(std::floor((2 * kLargestBlend + 1) * dice.uniform())) - kLargestBlend;
        });
        std::vector<int> shared;
        for (int i = 0; i < modes; ++i)
            if (dice.uniform() < 0.3) shared.push_back(i);
        weights(shared, Eigen::all).setZero();
        ByteWriter writer;
        put_blends(writer, weights, shared);
        ByteReader reader(writer.bytes());
        EXPECT_EQ(take_blends(reader, shared), weights);
        EXPECT_EQ(reader.left(), 0u);
    }
}

// One direction that many modes share is one blend.
TEST(StreamBlends, OneDirectionIsOneBlend) {
    const ConfigurationBasis basis = axes(3 * kHeldPoints);
    const Motion motion = along(slanted(), 2);
    const BlendWeights weights = needed_blends(basis, {0, 1}, held_points(), motion.positions, 0.1);
    ASSERT_EQ(weights.cols(), 1);
    EXPECT_EQ(weights.topRows(2).cwiseAbs().maxCoeff(), 0);
    const ConfigurationBasis blended{basis.mean, blended_modes(basis, weights)};
    const RowMatrix drawn = to_points(blended, fitted_components(blended, held_points(), motion.positions));
    EXPECT_LE(longest_triple(coordinates_of(drawn - motion.positions, held_points())), 0.1);
}

TEST(StreamBlends, AreAsManyAsTheOtherModesAtMost) {
    const ConfigurationBasis basis = axes(3);
    const Motion motion = smooth_motion(3, 2, 30, kHeldPoints);
    EXPECT_EQ(needed_blends(basis, {0}, held_points(), motion.positions, 0.1).cols(), 2);
    EXPECT_EQ(needed_blends(basis, {0, 1, 2}, held_points(), motion.positions, 0.1).cols(), 0);
}

// A talker who was seen in one direction and could move in all: a motion in a direction of its own takes one
// component more, in few bytes.
TEST(StreamBlends, AMotionInADirectionOfItsOwnTakesOneComponentMore) {
    Eigen::VectorXd first = Eigen::VectorXd::Zero(3 * kHeldPoints);
    first[0] = 1;
    ModelOptions options{.bounds_mm = {1}};
    options.also = RowMatrix::Constant(3 * kHeldPoints, kCoordinates, std::nan(""));
    options.also.leftCols(3 * kHeldPoints).setZero();
    for (int i = 0; i < 3 * kHeldPoints; ++i) options.also(i, i) = 10;
    const StreamModel model = learn_stream_model("somebody", {along(first, 4)}, options);
    ASSERT_GE(model.basis.size(), 3 * kHeldPoints - 1);
    const Motion motion = along(first + slanted(), 25);
    const EncodedStream encoded = encode_stream(motion, &model);
    const StreamModel* const models[] = {&model};
    const DecodedStream decoded = decode_stream(encoded.bytes, models);
    EXPECT_EQ(decoded.head.blends.cols() + decoded.head.directions.count(), 1);
    EXPECT_LE(decoded.basis.size(), 2);
    EXPECT_EQ(encoded.account.basis_bytes, 0u);
    const RowMatrix off = coordinates_of(decoded.positions(motion.time_s) - motion.positions, held_points());
    EXPECT_LE(longest_triple(off), 1);
}

TEST(StreamBlends, ThoseOfModesThatTheModelLacksAreRefused) {
    const ConfigurationBasis basis = axes(3);
    StreamModel model{"somebody", stored_basis(basis), {plain_statistics(3)}};
    StreamTools tools = shared_tools(model, held_points(), 1, {0});
    tools.head.blends = BlendWeights::Ones(4, 1);
    tools.head.blends(0, 0) = 0;
    const Bytes head = write_stream_head(tools);
    const StreamModel* const models[] = {&model};
    EXPECT_THROW(read_stream_head(head, models), std::runtime_error);
}

// Modes 0 and 1 differ, and 2 shows, where no point is measured.
ConfigurationBasis hardly_seen() {
    const int unseen = kCoordinates - 1;
    ConfigurationBasis basis = axes(4);
    basis.modes.col(1) = basis.modes.col(0);
    basis.modes(unseen, 1) = 0.1;
    basis.modes.col(2) *= 0.05;
    basis.modes(unseen, 2) = 1;
    return basis;
}

TEST(StreamBasis, ModesInUseAreIndependentAtThePoints) {
    const ConfigurationBasis basis = hardly_seen();
    EXPECT_EQ(independent_modes(basis, held_points(), 4), (std::vector<int>{0, 3}));
    EXPECT_EQ(independent_modes(basis, held_points(), 2), (std::vector<int>{0}));
    Eigen::VectorXd weights = Eigen::VectorXd::Zero(3 * kHeldPoints);
    weights << 1, 0, 1, 1, Eigen::VectorXd::Zero(3 * kHeldPoints - 4);
    const Motion motion = along(weights, 2);
    const std::vector<int> needed = needed_modes(basis, held_points(), motion.positions, 0.1);
    ASSERT_EQ(needed.size(), 2u);
    EXPECT_EQ(needed.back(), 3);
    const ConfigurationBasis used{basis.mean, basis.modes(Eigen::all, needed)};
    EXPECT_LE(fitted_components(used, held_points(), motion.positions).cwiseAbs().maxCoeff(), 10.001);
}

}  // namespace
}  // namespace viaface
