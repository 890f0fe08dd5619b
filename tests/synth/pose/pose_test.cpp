#include "synth/pose/pose.hpp"

#include "base/error.hpp"
#include "facemodel/remesh.hpp"
#include "talker.hpp"

namespace viaface {
namespace {

// The talker's points at rest, each moved by up to `reach` mm.
Configuration shaken(Dice& dice, double reach) {
    Configuration c = test_talker().training.rest;
    for (int i = 0; i < kCoordinates; ++i) c[i] += reach * (2 * dice.unit() - 1);
    return c;
}

double worst_on(const Nodes& a, const Nodes& b, const FacePart& part) {
    return (a - b).middleRows(part.first_node, part.nodes).rowwise().norm().maxCoeff();
}

TEST(Pose, ReachesEveryPostureOfItsTraining) {
    SKIP_WITHOUT_SCANS();
    const auto& talker = test_talker();
    for (const Posture& posture : talker_postures()) {
        const Nodes scan = talker.head.pose(posture.weights);
        const Nodes drawn = talker.poser.posed(talker.head.points(scan)), asked = talker.source.posed(scan);
        // The ridge of 0.3 mm holds back about as much.
        EXPECT_LT(worst_on(drawn, asked, part_of(talker.face, "skin")), 0.5) << posture.name;
    }
}

TEST(Pose, LipsAreWeldedToTheSkinAndTheMouthToTheLips) {
    SKIP_WITHOUT_SCANS();
    const auto& talker = test_talker();
    Dice dice(5);
    for (int k = 0; k < 20; ++k) {
        const Nodes drawn = talker.poser.posed(shaken(dice, 6), {dice.unit(), dice.unit()});
        for (Eigen::Index i = 0; i < drawn.rows(); ++i) {
            const int to = talker.face.weld[static_cast<std::size_t>(i)];
            ASSERT_LT((drawn.row(i) - drawn.row(to)).norm(), 1e-9) << "node " << i << " of shake " << k;
        }
    }
}

TEST(Pose, LipsThatAreAskedToCrossMeet) {
    SKIP_WITHOUT_SCANS();
    const auto& talker = test_talker();
    for (const double past : {0.2, 1.0, 2.0, 4.0}) {
        Configuration c = talker.training.rest;
        for (const int p : {kInnerTop, kInnerTopLeft, kInnerTopRight}) c[3 * p + 1] -= past / 2;
        for (const int p : {kInnerBottom, kInnerBottomLeft, kInnerBottomRight}) c[3 * p + 1] += past / 2;
        const Nodes rows = talker.poser.posed(c).middleRows(talker.face.lips.first_node, 600);
        for (const int column : {0, 3, 5, 7, 33, 35, 37}) {
            EXPECT_GE(lip_gap(rows, column), -1e-9) << past << " column " << column;
            EXPECT_LT(lip_gap(rows, column), 0.05) << past << " column " << column;
        }
    }
}

// The lips' mean height at the inner edge bounds every row from the middle inwards, on either side.
TEST(Pose, NoRowOfALipPassesTheOther) {
    SKIP_WITHOUT_SCANS();
    const auto& talker = test_talker();
    for (const char* name : {"m_pressed", "closed_clenched", "b_jaw_low", "corners_down"}) {
        const Configuration c = talker.head.points(talker.head.pose(posture(name).weights));
        const Nodes rows = talker.poser.posed(c).middleRows(talker.face.lips.first_node, 600);
        const auto at = [&](int row, int column) { return rows.row(row * LipGrid::kColumns + column); };
        for (int k = -6; k <= 6; ++k) {
            const int column = (k + LipGrid::kColumns) % LipGrid::kColumns, facing = facing_column(column);
            const double meeting = (at(14, column).y() + at(14, facing).y()) / 2;
            for (int row = LipGrid::kMiddleRow; row < LipGrid::kRows; ++row) {
                // The meeting line slopes by less than 0.4 across; nodes stand up to 0.5 mm beside their
                // column.
                EXPECT_GT(at(row, column).y(), meeting - 0.2)
                    << name << " row " << row << " column " << column;
                EXPECT_LT(at(row, facing).y(), meeting + 0.2)
                    << name << " row " << row << " column " << column;
            }
        }
    }
}

TEST(Pose, TheLowerLipStopsAtTheUpperIncisors) {
    SKIP_WITHOUT_SCANS();
    const auto& talker = test_talker();
    Configuration c = talker.head.points(talker.head.pose(posture("f").weights));
    for (const int p : {kInnerBottom, kInnerBottomLeft, kInnerBottomRight}) {
        c[3 * p + 1] = 3;   // 3 mm past the incisors' edge
        c[3 * p + 2] = -1;  // and behind their front
    }
    for (const int p : {kInnerTop, kInnerTopLeft, kInnerTopRight}) c[3 * p + 1] = 6;
    const Nodes drawn = talker.poser.posed(c);
    const auto inner = drawn.row(talker.face.lips.node(LipGrid::kRows - 1, 20));
    const FacePart& teeth = part_of(talker.face, "teeth_upper");
    const double edge = [&] {
        double lowest = 1e9;
        for (int i = teeth.first_node; i < teeth.first_node + teeth.nodes; ++i) {
            if (std::abs(talker.face.rest(i, 0)) < 4) lowest = std::min(lowest, talker.face.rest(i, 1));
        }
        return lowest;
    }();
    EXPECT_NEAR(inner.y(), edge, 1.0);
}

TEST(Pose, LowerTeethStayRigidWithTheirPoint) {
    SKIP_WITHOUT_SCANS();
    const auto& talker = test_talker();
    const Configuration c = talker.head.points(talker.head.pose({{"jawOpen", 0.7}}));
    const Nodes drawn = talker.poser.posed(c);
    const FacePart& teeth = part_of(talker.face, "teeth_lower");
    const int a = teeth.first_node, b = a + teeth.nodes - 1;
    EXPECT_NEAR((drawn.row(a) - drawn.row(b)).norm(),
                (talker.face.rest.row(a) - talker.face.rest.row(b)).norm(), 1e-9);
    const Configuration seen = talker.poser.drawn_points(drawn);
    // The point's step off the crown does not turn with the jaw: 18 degrees of at most 2 mm.
    EXPECT_LT((point_of(seen, kLowerIncisor) - point_of(c, kLowerIncisor)).norm(), 0.7);
}

TEST(Pose, MissingPointsAreEstimated) {
    SKIP_WITHOUT_SCANS();
    const auto& talker = test_talker();
    Configuration c = talker.head.points(talker.head.pose(posture("e").weights)), missing = c;
    for (const int p : {int{kLipTop}, int{kInnerBottom}, int{kTongueTip}, int{kLowerIncisor}}) {
        missing.segment<3>(3 * p).setConstant(std::nan(""));
    }
    const Configuration filled = talker.poser.completed(missing);
    EXPECT_TRUE(filled.allFinite());
    EXPECT_LT((filled - c).cwiseAbs().maxCoeff(), 1.0);
    EXPECT_EQ(point_of(filled, kChin), point_of(c, kChin));
    EXPECT_THROW(talker.poser.completed(Configuration::Constant(std::nan(""))), InputError);
}

TEST(Pose, DrawnPointsAreThoseAskedForWhereNothingTouches) {
    SKIP_WITHOUT_SCANS();
    const auto& talker = test_talker();
    const Configuration c = talker.head.points(talker.head.pose(posture("a").weights));
    const Configuration seen = talker.poser.drawn_points(talker.poser.posed(c));
    for (int p = 0; p < kLowerIncisor; ++p) {
        EXPECT_LT((point_of(seen, p) - point_of(c, p)).norm(), 0.4) << point_name(p);
    }
}

TEST(Pose, ABlinkShutsTheLids) {
    SKIP_WITHOUT_SCANS();
    const auto& talker = test_talker();
    const Nodes open = talker.poser.posed(talker.training.rest),
                shut = talker.poser.posed(talker.training.rest, {1, 0});
    const auto aperture = [&](const Nodes& nodes, const char* side) {
        const int upper = part_of(talker.face, std::string("lashes_upper_") + side).first_node + 6,
                  lower = part_of(talker.face, std::string("lashes_lower_") + side).first_node + 6;
        return nodes(upper, 1) - nodes(lower, 1);
    };
    EXPECT_GT(aperture(open, "left"), 7);
    EXPECT_LT(aperture(shut, "left"), 0.5);
    EXPECT_NEAR(aperture(shut, "right"), aperture(open, "right"), 1e-9);
}

TEST(Pose, EstimatorsSurviveTheirFile) {
    SKIP_WITHOUT_SCANS();
    const auto& talker = test_talker();
    const Bytes bytes = write_training(talker.training);
    const PoseTraining read = read_training(bytes);
    EXPECT_EQ(read.configurations, talker.training.configurations);
    EXPECT_EQ(read.contours, talker.training.contours);
    for (std::size_t size = 0; size < bytes.size(); size += 997) {
        EXPECT_THROW(read_training(std::span(bytes).first(size)), InputError);
    }
    Bytes flipped = bytes;
    flipped[bytes.size() / 2] ^= 1;
    EXPECT_THROW(read_training(flipped), InputError);
}

}  // namespace
}  // namespace viaface
