#include "viapoints/head_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/error.hpp"

namespace viaface {
namespace {

using Eigen::Vector3d;

const Points kFace = {{0, 90, 30}, {60, 95, 0}, {-60, 92, 5}, {0, 120, 10}, {0, -30, 20}, {25, 0, 10}};

// Four markers of the head, a chin that opens and a corner of the mouth, while the head nods and shifts.
PointRecording nodding(double noise_mm) {
    PointRecording r;
    r.labels = {"h1", "h2", "h3", "h4", "chin", "corner"};
    r.positions.resize(200, 18);
    for (int i = 0; i < 200; ++i) {
        const double t = i / 100.0;
        r.time_s.push_back(t);
        const Eigen::AngleAxisd turn(0.5 * std::sin(2 * t), Vector3d(1, 0.5, 0.2).normalized());
        for (int p = 0; p < 6; ++p) {
            Vector3d place = kFace[static_cast<std::size_t>(p)];
            if (p == 4) place.y() -= 8 * (1 - std::cos(9 * t));
            if (p == 5) place.x() += 4 * std::sin(7 * t);
            for (int axis = 0; axis < 3; ++axis)
                place[axis] += noise_mm * std::sin(1000.0 * (i + 7 * p) + 50 * axis);
            r.positions.block<1, 3>(i, 3 * p) = (turn * place + Vector3d(20 * t, -5 * t, 3)).transpose();
        }
    }
    return r;
}

TEST(RigidTurn, FindsTheTurnThatWasMade) {
    const Eigen::AngleAxisd turn(2.5, Vector3d(1, -2, 0.5).normalized());
    Points to;
    for (const Vector3d& p : kFace) to.push_back(turn * p + Vector3d(1, 2, 3));
    const RigidTurn found = rigid_turn(kFace, to);
    EXPECT_LT((found.turn.toRotationMatrix() - turn.toRotationMatrix()).norm(), 1e-12);
    EXPECT_LT((found.shift - Vector3d(1, 2, 3)).norm(), 1e-10);
    EXPECT_LT(found.residual_mm, 1e-10);
    EXPECT_LT((found.undone(to[1]) - kFace[1]).norm(), 1e-10);
}

// No turn near the one found does better.
TEST(RigidTurn, IsTheBestTurnOfPointsThatAlsoMoved) {
    Points to;
    for (std::size_t i = 0; i < kFace.size(); ++i)
        to.push_back(
            Eigen::AngleAxisd(0.7, Vector3d::UnitZ()) * kFace[i] +
            3 * Vector3d(std::sin(3.0 * static_cast<double>(i)), std::cos(5.0 * static_cast<double>(i)), 1));
    const RigidTurn best = rigid_turn(kFace, to);
    for (int k = 0; k < 3; ++k) {
        for (const double by : {-0.01, 0.01}) {
            RigidTurn other = best;
            other.turn = best.turn * Eigen::AngleAxisd(by, Vector3d::Unit(k));
            Vector3d middle = Vector3d::Zero();
            for (std::size_t i = 0; i < kFace.size(); ++i) middle += (to[i] - other.turn * kFace[i]) / 6;
            other.shift = middle;
            double squares = 0;
            for (std::size_t i = 0; i < kFace.size(); ++i) squares += (other(kFace[i]) - to[i]).squaredNorm();
            EXPECT_GT(std::sqrt(squares / 6), best.residual_mm);
        }
    }
}

TEST(HeadMotion, IsTakenOutByMarkersThatAreNamed) {
    const PointRecording moving = nodding(0);
    const HeadMotion head = head_motion(moving, {"h1", "h2", "h3", "h4"});
    EXPECT_LT(head.residual_mm, 1e-9);
    EXPECT_NEAR(head.widest_turn_degrees, 0.5 * 180 / std::numbers::pi, 0.1);
    const PointRecording still = without_head(moving, head);
    for (int p = 0; p < 4; ++p) {
        for (int i = 0; i < 200; ++i)
            EXPECT_LT((still.positions.block<1, 3>(i, 3 * p) - moving.positions.block<1, 3>(0, 3 * p)).norm(),
                      1e-9);
    }
    // the chin keeps its own way: 16 mm down
    EXPECT_NEAR((still.positions.middleCols<3>(12).rowwise() - still.positions.block<1, 3>(0, 12))
                    .rowwise()
                    .norm()
                    .maxCoeff(),
                16, 0.01);
}

TEST(HeadMotion, FindsTheLeastMovingPoints) {
    EXPECT_EQ(least_moving(nodding(0.1)), (std::vector<std::string>{"h1", "h2", "h3", "h4"}));
    const HeadMotion head = head_motion(nodding(0.1), least_moving(nodding(0.1)));
    EXPECT_GT(head.residual_mm, 0.05);
    EXPECT_LT(head.residual_mm, 0.2);
}

TEST(HeadMotion, GoesOnWithThreeOfFourMarkersAndNamesAFrameWithTwo) {
    PointRecording moving = nodding(0);
    moving.positions.block<1, 3>(50, 0).setConstant(std::nan(""));
    EXPECT_LT(head_motion(moving, {"h1", "h2", "h3", "h4"}).residual_mm, 1e-9);
    moving.positions.block<1, 3>(50, 3).setConstant(std::nan(""));
    try {
        head_motion(moving, {"h1", "h2", "h3", "h4"});
        FAIL();
    } catch (const InputError& error) {
        EXPECT_EQ(error.value(), "2 seen at 0.500000 s");
    }
}

TEST(HeadMotion, RefusesWhatCannotTurn) {
    const PointRecording moving = nodding(0);
    EXPECT_THROW(head_motion(moving, {"h1", "h2"}), InputError);
    EXPECT_THROW(head_motion(moving, {"h1", "h2", "h2"}), InputError);
    EXPECT_THROW(head_motion(moving, {"h1", "h2", "hat"}), InputError);
    PointRecording line = moving;
    for (int i = 0; i < 200; ++i) {
        for (int p = 0; p < 3; ++p) line.positions.block<1, 3>(i, 3 * p) << 10.0 * p, 0, 0;
    }
    EXPECT_THROW(head_motion(line, {"h1", "h2", "h3"}), InputError);
    PointRecording loose = moving;
    for (int k = 0; k < 18; ++k)
        loose.positions.col(k) += 10 * Eigen::VectorXd::LinSpaced(200, 0, 20 + k).array().sin().matrix();
    EXPECT_THROW(least_moving(loose), InputError);
}

}  // namespace
}  // namespace viaface
