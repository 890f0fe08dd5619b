// Lips followed through painted films whose lips are known.
#include "lipmodel/lip_tracker.hpp"

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "lipmodel/lip_thickness.hpp"
#include "painted_mouth.hpp"

namespace viaface {
namespace {

constexpr int kWidth = 200, kHeight = 220;
constexpr double kEyeDistance = 52, kMouthDown = 58;  // px

// A face that has moved by `shift` px: the painted mouth, and above it eyes, brows and a nose.
struct Film {
    LipPose pose{.shift = {0, 0, 1000}};
    Nodes lips(int frame) const {
        const test::Learned& l = test::learned_to_track();
        const MarkedPoints goal = l.frames.col(frame) - marked_of(as_column(l.body.mesh.nodes));
        return as_lip_nodes(as_column(l.body.mesh.nodes) + l.body.spread * goal);
    }

    test::Painting painting(const Eigen::Vector2d& shift, int frame) const {
        return {.width = kWidth,
                .height = kHeight,
                .camera = {.focal_px = 800, .centre_px = Eigen::Vector2d(100, 150) + shift},
                .noise = 3,
                .seed = 100u + static_cast<unsigned>(frame)};
    }

    test::Painted picture(int frame, const Eigen::Vector2d& shift) const {
        test::Painted made = test::paint(painting(shift, frame), lips(frame), pose);
        for (const auto& [x, y, r, dark] : {std::tuple(74, 92, 7, 90),
                                            {126, 92, 7, 90},
                                            {74, 80, 5, 70},
                                            {126, 80, 5, 70},
                                            {100, 112, 6, 25}}) {
            for (int v = 0; v < kHeight; ++v) {
                for (int u = 0; u < kWidth; ++u) {
                    const double far = std::hypot(u - x - shift.x(), v - y - shift.y()) / r;
                    for (int c = 0; c < 3; ++c) {
                        std::uint8_t& value = made.rgb[3 * (static_cast<std::size_t>(v) * kWidth + u) + c];
                        value = static_cast<std::uint8_t>(
                            std::max(0.0, value - dark * std::exp(-0.5 * far * far)));
                    }
                }
            }
        }
        return made;
    }

    FaceInPicture face(const Eigen::Vector2d& shift) const {
        return {.left_eye = Eigen::Vector2d(74, 92) + shift,
                .right_eye = Eigen::Vector2d(126, 92) + shift,
                .eyes_seen = true};
    }

    Pixels true_pixels(int frame, const Eigen::Vector2d& shift) const {
        return project(painting(shift, frame).camera, pose, lips(frame)).pixels;
    }
};

double gap(const Pixels& pixels) {
    double sum = 0;
    for (const int i : {-4, 0, 4})
        sum += pixels(LipMesh::node(LipMesh::kInnerRing, LipMesh::kBottom - i), 1) -
               pixels(LipMesh::node(LipMesh::kInnerRing, i), 1);
    return sum / 3;
}

struct Set {
    Film film;
    std::vector<test::Painted> pictures;
    std::vector<FaceSeen> seen;
    Set() {
        for (int i = 0; i < 4; ++i) pictures.push_back(film.picture(5 * i, {0, 0}));
        for (const auto& p : pictures) seen.push_back({p.picture(), film.face({0, 0})});
    }
};

TEST(LipTracker, FollowsLipsThatSpeakWhileTheHeadMoves) {
    const Set set;
    LipTracker tracker(test::learned_to_track().model, set.seen);
    std::vector<double> errors, gaps;
    for (int i = 0; i < 12; ++i) {
        const Eigen::Vector2d shift(0.7 * i, 2 * std::sin(0.5 * i));
        const auto picture = set.film.picture(3 * i, shift);
        const TrackedLips lips = tracker.next(picture.picture(), set.film.face(shift));
        ASSERT_TRUE(lips.found) << i;
        EXPECT_LE(lips.iterations, 19);
        EXPECT_GT(lips.confidence, 0.7);
        const Pixels truth = set.film.true_pixels(3 * i, shift);
        for (int column = 0; column < LipMesh::kColumns; ++column) {
            const int node = LipMesh::node(LipMesh::kBorderRing, column);
            errors.push_back((lips.pixels.row(node) - truth.row(node)).norm());
        }
        gaps.push_back(std::abs(std::max(0.0, gap(lips.pixels)) - gap(truth)));
    }
    const auto median = [](std::vector<double>& v) {
        std::ranges::sort(v);
        return v[v.size() / 2];
    };
    EXPECT_LT(median(errors), 1.5);  // px; the nodes slide along a border that colours do not mark
    EXPECT_LT(median(gaps), 1.0);    // px
}

TEST(LipTracker, SaysThatItIsLostAndRecovers) {
    const Set set;
    LipTracker tracker(test::learned_to_track().model, set.seen);
    const Eigen::Vector2d still(0, 0);
    EXPECT_TRUE(tracker.next(set.pictures[0].picture(), set.film.face(still)).found);
    const test::Painted black{kWidth, kHeight, std::vector<std::uint8_t>(3u * kWidth * kHeight, 0)};
    const TrackedLips lost = tracker.next(black.picture());
    EXPECT_FALSE(lost.found);
    EXPECT_EQ(lost.confidence, 0);
    EXPECT_FALSE(tracker.next(black.picture()).found);
    const Eigen::Vector2d elsewhere(12, -5);
    const auto again = set.film.picture(4, elsewhere);
    EXPECT_TRUE(tracker.next(again.picture(), set.film.face(elsewhere)).found);
}

TEST(LipTracker, RefusesAMouthTooSmall) {
    const Set set;
    std::vector<FaceSeen> seen = set.seen;
    for (FaceSeen& s : seen) s.mouth = MouthInPicture{.centre = {100, 150}, .width = 8, .height = 3};
    EXPECT_THROW(LipTracker(test::learned_to_track().model, seen), InputError);
    EXPECT_THROW(LipTracker(test::learned_to_track().model, {}), std::invalid_argument);
}

TEST(MouthFinder, FindsTheRedBelowTheEyes) {
    const Film film;
    const Eigen::Vector2d shift(6, -4);
    const auto picture = film.picture(10, shift);
    const MouthInPicture mouth = find_mouth(picture.picture(), film.face(shift));
    const Pixels truth = film.true_pixels(10, shift);
    const auto border = truth.middleRows(LipMesh::node(LipMesh::kBorderRing, 0), LipMesh::kColumns);
    const Eigen::RowVector2d middle = 0.5 * (border.colwise().minCoeff() + border.colwise().maxCoeff());
    EXPECT_LT((mouth.centre.transpose() - middle).norm(), 0.1 * kEyeDistance);
}

TEST(HeadFollower, FindsAKnownMove) {
    const Film film;
    const auto first = film.picture(0, {0, 0});
    const HeadFollower follower(first.picture(), {55, 68, 90, 56});
    const Eigen::Vector2d shift(4.3, -2.6);
    const auto moved = film.picture(0, shift);
    const Followed followed = follower.follow(moved.picture(), follower.still());
    EXPECT_LT((followed.move.shift - shift).norm(), 0.2);  // px, under noise of 3 grey levels
    EXPECT_NEAR(followed.move.scale(), 1, 0.01);
    EXPECT_GT(followed.likeness, 0.9);
    const test::Painted black{kWidth, kHeight, std::vector<std::uint8_t>(3u * kWidth * kHeight, 0)};
    EXPECT_LT(follower.follow(black.picture(), follower.still()).likeness, 0.5);
}

TEST(Thickness, MovesBordersAndSkinNotTheInnerEdge) {
    const LipModel thick = with_thickness(test::learned_to_track().model, 1);
    const Eigen::Index modes = test::learned_to_track().model.modes.cols();
    ASSERT_EQ(thick.modes.cols(), modes + kThicknessModes);
    const Eigen::MatrixXd gram = thick.modes.transpose() * thick.modes;
    EXPECT_LT((gram - Eigen::MatrixXd::Identity(gram.rows(), gram.cols())).cwiseAbs().maxCoeff(), 1e-9);
    EXPECT_GT(thick.variance[modes], 0);
}

TEST(FaceFinder, SeesNoFaceInNoise) {
    test::Noise noise(5);
    test::Painted picture{120, 90, {}};
    for (int i = 0; i < 3 * 120 * 90; ++i)
        picture.rgb.push_back(static_cast<std::uint8_t>(127 + 100 * noise()));
    FaceFinder finder;
    EXPECT_FALSE(finder.find(picture.picture()).has_value());
    EXPECT_THROW(FaceFinder("no/such/folder"), std::runtime_error);
}

}  // namespace
}  // namespace viaface
