#include "synth/pose/eye_ball.hpp"
#include "talker.hpp"

namespace viaface {
namespace {

constexpr double kRadians = 3.14159265358979 / 180;

Eigen::Vector3d looks(const Nodes& posed, const char* name, double side) {
    const FacePart& eye = part_of(test_talker().face, name);  // its last node is the cornea's foremost place
    return (posed.row(eye.first_node + eye.nodes - 1).transpose() - eye_ball(side).centre).normalized();
}

double upper_lid(const Nodes& posed) {
    return posed(part_of(test_talker().face, "lashes_upper_left").first_node + 6, 1);
}

TEST(Gaze, EyesLookWhereTheyAreAskedTo) {
    SKIP_WITHOUT_SCANS();
    const auto& talker = test_talker();
    for (const Gaze gaze : {Gaze{20, 0}, Gaze{-15, 10}, Gaze{0, -25}}) {
        const Nodes posed = talker.poser.posed(talker.training.rest, {}, gaze);
        const Eigen::Vector3d wanted(std::sin(gaze.left * kRadians) * std::cos(gaze.up * kRadians),
                                     std::sin(gaze.up * kRadians),
                                     std::cos(gaze.left * kRadians) * std::cos(gaze.up * kRadians));
        EXPECT_LT((looks(posed, "eye_left", 1) - wanted).norm(), 1e-6);
        EXPECT_LT((looks(posed, "eye_right", -1) - wanted).norm(), 1e-6);
    }
}

TEST(Gaze, LidsFollowItUpAndDown) {
    SKIP_WITHOUT_SCANS();
    const auto& talker = test_talker();
    const auto lid = [&](double up) {
        return upper_lid(talker.poser.posed(talker.training.rest, {}, {0, up}));
    };
    EXPECT_LT(lid(-20), lid(0) - 1.5);
    EXPECT_GT(lid(10), lid(0) + 0.5);
}

TEST(Gaze, NoLidSinksIntoAnEye) {
    SKIP_WITHOUT_SCANS();
    const auto& talker = test_talker();
    const Nodes open = talker.poser.posed(talker.training.rest);
    const FacePart& roots = part_of(talker.face, "lashes_upper_left");
    for (const Gaze gaze : {Gaze{25, -15}, Gaze{-25, 15}, Gaze{0, -30}}) {
        for (const double blink : {0.0, 0.5, 1.0}) {
            const Nodes posed = talker.poser.posed(talker.training.rest, {blink, blink}, gaze);
            const EyeBall ball = eye_ball(1);
            for (int i = 2; i < 11; ++i) {
                const Eigen::Vector3d from = posed.row(roots.first_node + i).transpose() - ball.centre;
                const double rest = (open.row(roots.first_node + i).transpose() - ball.centre).norm();
                EXPECT_GT(from.norm(), std::min(rest, EyeBall::kRadius)) << i << " blink " << blink;
            }
        }
    }
}

}  // namespace
}  // namespace viaface
