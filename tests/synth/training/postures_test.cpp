#include "synth/training/postures.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "base/decompositions.hpp"
#include "scans.hpp"

namespace viaface {
namespace {

double opening(const Configuration& c) { return c[3 * kInnerTop + 1] - c[3 * kInnerBottom + 1]; }
double width(const Configuration& c) { return c[3 * kBorderLeft] - c[3 * kBorderRight]; }
double protrusion(const Configuration& c) { return c[3 * kBorderTop + 2] + c[3 * kBorderBottom + 2]; }

Configuration points_of(const std::string& name) {
    const BlendHead& head = test::blend_head();
    return head.points(head.pose(posture(name).weights));
}

// Any mix of the shapes is a mix of the postures when their weights, less the mean, have as many independent
// directions as there are shapes; the smallest says how far a posture is stretched to get there.
TEST(Postures, TheTalkersSpanEveryShapeOfSpeech) {
    const auto& postures = talker_postures();
    const auto& names = spanned_shapes();
    Eigen::MatrixXd weights = Eigen::MatrixXd::Zero(names.size(), postures.size());
    for (std::size_t k = 0; k < postures.size(); ++k) {
        for (const auto& [name, weight] : postures[k].weights) {
            weights(std::ranges::find(names, name) - names.begin(), k) = weight;
        }
    }
    weights.colwise() -= weights.rowwise().mean().eval();
    const Eigen::VectorXd s = thin_svd(weights).s;
    EXPECT_GT(s[static_cast<Eigen::Index>(names.size()) - 1], 0.05);
    for (const char* name : {"jawOpen", "jawForward", "mouthClose", "mouthFunnel", "mouthPucker",
                             "mouthStretch", "mouthSmile", "mouthLowerDown", "mouthUpperUp", "mouthPress",
                             "mouthRollLower", "mouthRollUpper", "mouthShrugLower", "mouthShrugUpper",
                             "mouthDimple", "mouthFrown", "cheekPuff", "mouthLeft", "mouthRight"}) {
        EXPECT_TRUE(std::ranges::binary_search(names, name)) << name;
    }
}

TEST(Postures, TheTalkersBeginWithTheReportsEight) {
    ASSERT_EQ(report_postures().size(), 8u);
    for (std::size_t k = 0; k < 8; ++k) {
        EXPECT_EQ(talker_postures()[k].name, report_postures()[k].name);
        EXPECT_EQ(talker_postures()[k].weights, report_postures()[k].weights);
    }
    EXPECT_THROW(posture("x"), std::invalid_argument);
}

TEST(Postures, TheMouthDoesWhatTheNameSays) {
    SKIP_WITHOUT_SCANS();
    const Configuration rest = points_of("closed_relaxed");
    EXPECT_NEAR(opening(rest), 0, 0.5);
    EXPECT_GT(opening(points_of("a")), 12);
    EXPECT_LT(opening(points_of("a")), 16);
    EXPECT_GT(opening(points_of("mouth_open")), 20);
    EXPECT_GT(width(points_of("i")) - width(points_of("u")), 10);
    EXPECT_GT(protrusion(points_of("u")), protrusion(rest) + 8);
    for (const char* closed :
         {"closed_clenched", "m_pressed", "b_jaw_low", "corners_down", "cheeks_puffed"}) {
        EXPECT_LT(opening(points_of(closed)), 0) << closed;
        EXPECT_GT(opening(points_of(closed)), -3) << closed;
    }
    EXPECT_LT(points_of("b_jaw_low")[3 * kLowerIncisor + 1], rest[3 * kLowerIncisor + 1] - 5);
    EXPECT_GT(point_of(points_of("mouth_left"), kLipTop).x(), 2);
    EXPECT_LT(point_of(points_of("mouth_right"), kLipTop).x(), -2);
}

}  // namespace
}  // namespace viaface
