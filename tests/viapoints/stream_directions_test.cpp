#include "viapoints/stream_directions.hpp"

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

constexpr int kHeld = 4, kReach = 3 * kHeld;  // points, and their coordinates

std::vector<int> held_points() { return {0, 1, 2, 3}; }

// Each mode moves one coordinate.
ConfigurationBasis axes(int modes) {
    ConfigurationBasis basis{Configuration::Constant(std::nan("")),
                             Eigen::MatrixXd::Identity(kCoordinates, modes)};
    basis.mean.head(kReach).setZero();
    return basis;
}

Eigen::VectorXd drawn(Dice& dice) {
    return Eigen::VectorXd::NullaryExpr(kReach, [&] { return dice.normal(); }).normalized();
}

// Along each of `ways` by a wave of its own, which is `reach` high for the first one and half as high for
// each further one, mm.
Motion along(const std::vector<Eigen::VectorXd>& ways, double reach, double seconds) {
    Motion motion;
    const auto samples = static_cast<Eigen::Index>(30 * seconds);
    motion.positions = RowMatrix::Constant(samples, kCoordinates, std::nan(""));
    motion.positions.leftCols(kReach).setZero();
    for (Eigen::Index i = 0; i < samples; ++i) {
        const double t = static_cast<double>(i) / 30;
        motion.time_s.push_back(t);
        for (std::size_t w = 0; w < ways.size(); ++w)
            motion.positions.row(i).head(kReach) += std::ldexp(reach, -static_cast<int>(w)) *
                                                    std::sin((9 + 2.3 * double(w)) * t) * ways[w].transpose();
    }
    return motion;
}

// Who was seen in one direction and could move in all.
StreamModel one_way_model() {
    ModelOptions options{.bounds_mm = {1}};
    options.also = RowMatrix::Constant(kReach, kCoordinates, std::nan(""));
    options.also.leftCols(kReach) = 10 * RowMatrix::Identity(kReach, kReach);
    return learn_stream_model("somebody", {along({Eigen::VectorXd::Unit(kReach, 0)}, 10, 4)}, options);
}

TEST(StreamDirections, AreReadAsTheyWereWritten) {
    Dice dice(2);
    for (int n = 0; n < 50; ++n) {
        const int modes = static_cast<int>(60 * dice.uniform()), count = static_cast<int>(9 * dice.uniform());
        StreamDirections directions;
        directions.weights = Eigen::MatrixXi::NullaryExpr(
            modes, count, [&] { return static_cast<int>(std::floor(2049 * dice.uniform())) - 1024; });
        for (int d = 0; d < count; ++d) {
            directions.shift.push_back(static_cast<int>((kMostShift + 1) * dice.uniform()));
            directions.chance.push_back(static_cast<std::uint8_t>(256 * dice.uniform()));
        }
        ByteWriter writer;
        put_directions(writer, directions);
        ByteReader reader(writer.bytes());
        const StreamDirections read = take_directions(reader);
        EXPECT_EQ(read.weights, directions.weights);
        EXPECT_EQ(read.shift, directions.shift);
        EXPECT_EQ(read.chance, directions.chance);
        EXPECT_EQ(reader.left(), 0u);
    }
}

TEST(StreamDirections, AreAsManyAsTheMotionHas) {
    Dice dice(3);
    const Motion motion = along({drawn(dice), drawn(dice), drawn(dice)}, 60, 4);
    const ConfigurationBasis basis = axes(kReach);
    const StreamDirections directions = needed_directions(basis, held_points(), motion.positions, 0.1);
    EXPECT_EQ(directions.count(), 3);
    const ConfigurationBasis used{basis.mean, modes_along(basis, directions)};
    const RowMatrix off =
        to_points(used, fitted_components(used, held_points(), motion.positions)) - motion.positions;
    EXPECT_LE(longest_triple(coordinates_of(off, held_points())), 0.1);
}

TEST(StreamDirections, StayWithinTheBasis) {
    Dice dice(4);
    const Motion motion = along({drawn(dice)}, 10, 2);
    EXPECT_LE(needed_directions(axes(2), held_points(), motion.positions, 0.1).count(), 2);
    EXPECT_EQ(needed_directions(axes(kReach), held_points(), motion.positions, 11).count(), 0);
}

// Ways that the talker was not seen to go, all of them mixtures of his modes: as few components as ways,
// whose telling costs less than modes would (12 numbers of two bytes each).
TEST(StreamDirections, AStreamHasAsManyComponentsAsTheMotion) {
    const StreamModel model = one_way_model();
    ASSERT_GE(model.basis.size(), kReach - 1);
    Dice dice(5);
    const Motion motion = along({drawn(dice), drawn(dice), drawn(dice)}, 40, 12);
    const EncodedStream encoded = encode_stream(motion, &model);
    const StreamModel* const models[] = {&model};
    const DecodedStream decoded = decode_stream(encoded.bytes, models);
    EXPECT_GE(decoded.head.directions.count(), 3);
    EXPECT_LE(decoded.head.directions.count(), 4);
    EXPECT_EQ(decoded.basis.size(), decoded.head.directions.count());
    EXPECT_EQ(encoded.account.basis_bytes, 0u);
    EXPECT_LT(encoded.account.head_bytes,
              write_stream_head(shared_tools(model, held_points(), 1, {})).size() + 3 * 24);
    const RowMatrix off = coordinates_of(decoded.positions(motion.time_s) - motion.positions, held_points());
    EXPECT_LE(longest_triple(off), 1);
}

TEST(StreamDirections, WhatCannotBeIsRefused) {
    const StreamModel model{"somebody", stored_basis(axes(3)), {plain_statistics(3)}};
    const StreamModel* const models[] = {&model};
    const auto head_with = [&](int modes, int shift) {
        StreamTools tools = shared_tools(model, held_points(), 1, {0});
        tools.head.directions = {Eigen::MatrixXi::Ones(modes, 1), {shift}, {100}};
        return write_stream_head(tools);
    };
    EXPECT_EQ(read_stream_head(head_with(3, kMostShift), models).tools.basis.size(), 2);
    EXPECT_THROW(read_stream_head(head_with(4, 0), models), std::runtime_error);
    EXPECT_THROW(read_stream_head(head_with(3, kMostShift + 1), models), std::runtime_error);
}

}  // namespace
}  // namespace viaface
