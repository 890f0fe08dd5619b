#include "facemodel/field_morph.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <stdexcept>

#include "ensemble.hpp"

namespace viaface {
namespace {

using Eigen::Vector2d;

std::vector<MorphLine> some_lines() {
    const Eigen::MatrixXd ends = 50 * test::noise(4, 6, 31);
    std::vector<MorphLine> lines;
    for (int i = 0; i < 6; ++i) lines.push_back({ends.col(i).head<2>(), ends.col(i).tail<2>()});
    return lines;
}

TEST(FieldMorph, UnmovedLinesMoveNothing) {
    const FieldMorph morph(some_lines(), some_lines());
    for (const Vector2d& place : {Vector2d(0, 0), Vector2d(30, -20), Vector2d(-200, 7)}) {
        EXPECT_LT((morph(place) - place).norm(), 1e-9);
    }
}

// Each line by itself carries the plane by the rotation and shift that carry the line, so a field of lines
// that agree does the same.
TEST(FieldMorph, RigidMotionOfTheLinesIsRigidMotionOfThePlane) {
    const Eigen::Rotation2Dd turned(0.7);
    const Vector2d shift(12, -5);
    std::vector<MorphLine> after = some_lines();
    for (MorphLine& line : after) line = {turned * line.from + shift, turned * line.to + shift};
    const FieldMorph morph(some_lines(), after);
    for (const Vector2d& place : {Vector2d(0, 0), Vector2d(30, -20), Vector2d(-200, 7)}) {
        EXPECT_LT((morph(place) - (turned * place + shift)).norm(), 1e-9);
    }
}

// On a line its own weight is (l^p / a)^b; the others' share of the displacement falls with a^b.
TEST(FieldMorph, ALineGoesToItsGoal) {
    const std::vector<MorphLine> before = {{{0, 0}, {10, 0}}, {{0, 100}, {10, 100}}};
    const std::vector<MorphLine> after = {{{0, 0}, {10, 0}}, {{0, 120}, {10, 120}}};
    const FieldMorph morph(before, after, {.a = 0.1, .b = 2, .p = 0.5});
    const double leak = 20 * std::pow(0.1 / 100, 2);
    EXPECT_LT((morph({5, 0}) - Vector2d(5, 0)).norm(), 1.01 * leak);
    EXPECT_LT((morph({5, 100}) - Vector2d(5, 120)).norm(), 1.01 * leak);
    EXPECT_NEAR(morph({5, 50}).y(), 60, 1e-9);
}

TEST(FieldMorph, RefusesLinesThatDoNotPair) {
    EXPECT_THROW(FieldMorph({}, {}), std::invalid_argument);
    EXPECT_THROW(FieldMorph(some_lines(), {{{0, 0}, {1, 0}}}), std::invalid_argument);
    EXPECT_THROW(FieldMorph({{{0, 0}, {0, 0}}}, {{{0, 0}, {1, 0}}}), std::invalid_argument);
}

}  // namespace
}  // namespace viaface
