#include "lipmodel/lip_tracker.hpp"

#include <algorithm>
#include <cmath>

namespace viaface {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kLeastLikeness = 0.7, kLeastConfidence = 0.45;
constexpr int kPatience = 3;  // pictures of low confidence until the track is lost
constexpr PoseFreedom kFreedom{.turn = 0.02, .shift = 0.7, .scale = 0};

// Brows to nose: what speech leaves still.
PictureBox still_part(const Picture& picture, const FaceInPicture& face) {
    const double far = face.eye_distance();
    return box_about(picture, face.middle() + 0.2 * far * face.down(), 0.75 * far, 0.5 * far);
}

}  // namespace

class LipTracker::Tracking {
  public:
    Tracking(const LipModel& model, std::span<const FaceSeen> seen, const TrackerOptions& options)
        : mouth_(learn_mouth(model, seen, options)),
          eye_distance_mm_(options.eye_distance_mm),
          face_(seen.back().face),
          still_(mouth_.still()) {}

    TrackedLips next(const Picture& picture, const std::optional<FaceInPicture>& face) {
        if (follower_) {
            TrackedLips lips = followed(picture);
            if (lips.found) return lips;
        }
        if (!find_again(picture, face ? face : found(picture))) return {};
        return followed(picture);
    }

    const Vector3d& scale() const { return mouth_.scale; }
    double mouth_px() const { return mouth_.width_px; }

  private:
    TrackedLips followed(const Picture& picture) {
        const Followed followed = follower_->follow(picture, head_);
        if (followed.likeness < kLeastLikeness) return lose();
        head_ = followed.move;
        const LipPose expected = mouth_.placing.pose(head_(mouth_then_), roll_then_ + head_.roll(),
                                                     shrink_then_ * head_.scale(), mouth_.scale);
        TrackedLips lips = climbed(picture, expected, kFreedom);
        doubted_ = lips.confidence < kLeastConfidence ? doubted_ + 1 : 0;
        if (doubted_ >= kPatience) return lose();
        last_ = lips.p;
        return lips;
    }

    TrackedLips climbed(const Picture& picture, const LipPose& expected, const PoseFreedom& freedom) const {
        const Vector2d centre = mouth_.placing.centre_of(expected);
        const double roll = expected.turn.z();
        const PictureBox box = mouth_.box(picture, centre);
        const std::vector<std::uint8_t> rgb =
            evened(picture, box, mouth_.light, {centre, {std::cos(roll), std::sin(roll)}});
        const ProbableLips best = mouth_.most_probable({picture.width, picture.height, rgb}, box, expected,
                                                       freedom, {last_.size() ? last_ : still_, still_});
        TrackedLips lips{.found = true,
                         .p = best.p,
                         .pose = best.pose,
                         .log_posterior = best.log_posterior,
                         .confidence = best.confidence,
                         .iterations = best.iterations};
        const Nodes shape = as_lip_nodes(lip_shape(mouth_.model, lips.p));
        lips.shape = shape * mouth_.scale.asDiagonal();
        lips.pixels = project(mouth_.placing.camera, lips.pose, shape).pixels;
        return lips;
    }

    bool find_again(const Picture& picture, const std::optional<FaceInPicture>& face) {
        if (!face) return false;
        const PictureBox still = still_part(picture, *face);
        if (std::min(still.width, still.height) < HeadFollower::kLeastSide) return false;
        face_ = face;
        follower_.emplace(picture, still);
        head_ = follower_->still();
        shrink_then_ = face->eye_distance() / (mouth_.placing.px_per_mm * eye_distance_mm_);
        roll_then_ = roll_of(*face);
        const Vector2d below = mouth_.below_eyes * face->eye_distance();
        const LipPose expected =
            mouth_.placing.pose(face->middle() + below.x() * face->along() + below.y() * face->down(),
                                roll_then_, shrink_then_, mouth_.scale);
        mouth_then_ = mouth_.placing.centre_of(climbed(picture, expected, kFirstFreedom).pose);
        return true;
    }

    std::optional<FaceInPicture> found(const Picture& picture) {
        if (!finder_) finder_.emplace();
        return finder_->find(picture, face_);
    }

    TrackedLips lose() {
        follower_.reset();
        doubted_ = 0;
        last_ = still_;
        return {};
    }

    KnownMouth mouth_;
    double eye_distance_mm_;
    std::optional<FaceFinder> finder_;   // once it is needed
    std::optional<FaceInPicture> face_;  // as it was found last
    Eigen::VectorXd still_, last_;
    std::optional<HeadFollower> follower_;
    Similarity head_;
    Vector2d mouth_then_ = Vector2d::Zero();
    double shrink_then_ = 1, roll_then_ = 0;
    int doubted_ = 0;
};

LipTracker::LipTracker(const LipModel& model, std::span<const FaceSeen> seen, const TrackerOptions& options)
    : tracking_(std::make_unique<Tracking>(model, seen, options)) {}
LipTracker::~LipTracker() = default;

TrackedLips LipTracker::next(const Picture& picture, const std::optional<FaceInPicture>& face) {
    return tracking_->next(picture, face);
}
const Vector3d& LipTracker::scale() const { return tracking_->scale(); }
double LipTracker::mouth_px() const { return tracking_->mouth_px(); }

}  // namespace viaface
