#include "synth/motion/recorded_head.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "synth/pose/head_sway.hpp"

namespace viaface {
namespace {

using Eigen::Vector3d;

Motion turned(std::vector<ExtraColumn> columns) {
    Motion motion;
    for (std::size_t i = 0; i < columns.front().values.size(); ++i)
        motion.time_s.push_back(0.1 * static_cast<double>(i));
    motion.positions = RowMatrix::Zero(static_cast<Eigen::Index>(motion.size()), kCoordinates);
    motion.extra = std::move(columns);
    return motion;
}

// Where the middle of the incisors' edge goes, seen from the neck.
Vector3d mouth(const Eigen::Isometry3d& head) { return head * Vector3d::Zero() - kNeckPivot; }

TEST(RecordedHead, TurnsToTheSideThatTheNameTells) {
    const Vector3d rest = -kNeckPivot;
    const auto yaw = recorded_head(turned({{"HeadYaw", {0, 0.3}}}));
    ASSERT_EQ(yaw.size(), 2u);
    EXPECT_GT(mouth(yaw[1]).x(), rest.x() + 10);  // to the talker's left
    EXPECT_NEAR(mouth(yaw[1]).y(), rest.y(), 1e-9);
    EXPECT_LT(mouth(recorded_head(turned({{"HeadPitch", {0, 0.3}}}))[1]).y(), rest.y() - 10);  // chin down
    const auto roll = recorded_head(turned({{"headRoll", {0, 0.3}}}));
    EXPECT_NEAR(mouth(roll[1]).z(), rest.z(), 1e-9);
    EXPECT_LT(mouth(roll[1]).x(), rest.x() - 5);  // the mouth is above the neck: towards the right ear
}

TEST(RecordedHead, TurnsAboutTheNeckByTheAnglesTold) {
    const auto head = recorded_head(turned({{"HeadYaw", {0, 0.2}}, {"HeadPitch", {0, 0}}}));
    EXPECT_LT((head[1] * kNeckPivot - kNeckPivot).norm(), 1e-9);
    EXPECT_NEAR(widest_turn_degrees(head), 0.2 * 180 / M_PI, 1e-9);
}

TEST(RecordedHead, CountsFromTheFirstSample) {
    const auto head = recorded_head(turned({{"HeadYaw", {0.5, 0.7, 0.5}}}));
    EXPECT_TRUE(head[0].isApprox(Eigen::Isometry3d::Identity(), 1e-12));
    EXPECT_TRUE(head[2].isApprox(Eigen::Isometry3d::Identity(), 1e-12));
    EXPECT_NEAR(widest_turn_degrees(head), 0.2 * 180 / M_PI, 1e-9);
}

TEST(RecordedHead, StaysWhereATurnIsMissing) {
    const auto head = recorded_head(turned({{"HeadYaw", {0, 0.2, std::nan("")}}}));
    EXPECT_TRUE(head[2].isApprox(head[1]));
}

TEST(RecordedHead, IsNoneWithoutTurns) {
    EXPECT_TRUE(recorded_head(turned({{"LeftEyeYaw", {0, 1}}})).empty());
    EXPECT_TRUE(recorded_head(turned({{"HeadYaw", {0, 0}}})).empty());
}

}  // namespace
}  // namespace viaface
