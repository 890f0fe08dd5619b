#include "synth/pose/inside.hpp"

#include <gtest/gtest.h>

namespace viaface {
namespace {

using Eigen::Vector3d;

TEST(JawMotion, BringsTheIncisorToItsPointAndStaysRigid) {
    const Vector3d hinge(0, 30, -88), rest(0, 0.3, -2), now(1.5, -18, -9);
    const JawMotion jaw = jaw_motion(hinge, rest, now);
    EXPECT_LT((jaw(rest) - now).norm(), 1e-12);
    const Vector3d a(20, -5, -30), b(-12, -8, -14);
    EXPECT_NEAR((jaw(a) - jaw(b)).norm(), (a - b).norm(), 1e-12);
}

TEST(JawMotion, ATurnAboutTheHingeNeedsNoShift) {
    const Vector3d hinge(0, 30, -88), rest(0, 0.3, -2);
    const Eigen::AngleAxisd turn(0.3, Vector3d::UnitX());
    const JawMotion jaw = jaw_motion(hinge, rest, hinge + turn * (rest - hinge));
    EXPECT_LT(jaw.shift.norm(), 1e-12);
    EXPECT_TRUE(jaw.turn.isApprox(turn.toRotationMatrix(), 1e-12));
}

TEST(Tongue, FollowsItsPointsWhereTheySit) {
    const Nodes rest = TongueSweep::rest();
    const std::array<Vector3d, 3> points = {Vector3d(0, -0.5, -16), Vector3d(0, 3, -35),
                                            Vector3d(0, 3.5, -55)};
    std::array<Vector3d, 3> moved = points;
    moved[0] += Vector3d(0, 7, 3);
    const Nodes posed = TongueSweep::posed(rest, points, moved, JawMotion{});
    double tip = 0, root = 0;
    for (Eigen::Index i = 0; i < rest.rows(); ++i) {
        const double move = (posed.row(i) - rest.row(i)).norm();
        if (rest(i, 2) > points[0].z()) tip = std::max(tip, move);
        if (rest(i, 2) < points[1].z()) root = std::max(root, move);
    }
    EXPECT_NEAR(tip, Vector3d(0, 7, 3).norm(), 1e-9);
    EXPECT_EQ(root, 0);
}

TEST(Mouth, LiningStartsAtTheLipsAndItsThroatStays) {
    Contour inner = Contour::Zero();
    for (int c = 0; c < LipGrid::kColumns; ++c)
        inner.row(c) << 20 * std::sin(0.157 * c), std::cos(0.157 * c), 5;
    const Nodes rest = MouthLining::rest(inner);
    Contour opened = inner;
    opened.col(1) *= 10;
    const Nodes posed = MouthLining::posed(rest, opened, JawMotion{});
    EXPECT_TRUE(posed.topRows(LipGrid::kColumns).isApprox(opened));
    EXPECT_TRUE(posed.bottomRows(1).isApprox(rest.bottomRows(1)));
}

// Seen from the front, parted lips end in their own edge: the lining right behind lies farther from the
// opening.
TEST(Mouth, LiningHidesBehindPartedLips) {
    Contour inner;
    for (int c = 0; c < LipGrid::kColumns; ++c)
        inner.row(c) << 20 * std::sin(0.157 * c), 0.5 * std::cos(0.157 * c), 5;
    const Nodes rest = MouthLining::rest(inner);
    Contour parted = inner;
    parted.col(1) *= 12;
    const Nodes shut = MouthLining::posed(rest, inner, JawMotion{}),
                open = MouthLining::posed(rest, parted, JawMotion{});
    const int behind = LipGrid::kColumns, lower = LipGrid::kColumns / 2;
    for (int c = -4; c <= 4; ++c) {
        const int above = (c + LipGrid::kColumns) % LipGrid::kColumns, below = lower + c;
        EXPECT_GT(open(behind + above, 1), parted(above, 1));
        EXPECT_LT(open(behind + below, 1), parted(below, 1));
        EXPECT_LT(shut(behind + above, 1), inner(above, 1));  // shut, they reach past each other
        EXPECT_GT(shut(behind + below, 1), inner(below, 1));
    }
}

}  // namespace
}  // namespace viaface
