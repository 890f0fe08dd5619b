// Lips followed through the pictures of a film. [Basu98, section 5] What the paper does by hand is done here:
//   - the face and its eyes are found by cascades, the mouth below them by its red; the distance of the eyes
//     gives the scale, which is stated and not measured;
//   - scales and colour classes are learned from the first pictures (first_pictures.hpp);
//   - from then on the head is followed by the still part of the face (head_follower.hpp), and every picture
//     is climbed from where the last one ended (and, where that is higher, from the mean shape).
// A track whose confidence falls is lost; the face is looked for again in every picture until it is found.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lipmodel/first_pictures.hpp"
#include "lipmodel/head_follower.hpp"

namespace viaface {

struct TrackedLips {
    bool found = false;
    Eigen::VectorXd p = {};    // of the tracker's modes: the model's, then the two of thickness
    LipPose pose = {};         // scales are the talker's
    Nodes shape = {};          // [204 x 3], mm: the talker's own, scaled; head frame
    Pixels pixels = {};        // of all nodes [204 x 2], px
    double log_posterior = 0;  // but for a constant
    double confidence = 0;  // 0 to 1: how well colours fit the classes of what is over them, mean over area
    int iterations = 0;
};

class LipTracker {
  public:
    // seen: some pictures of the film's beginning, at least one; not needed afterwards. InputError("video",
    // ...) when the mouth is too small or cannot be told from the skin.
    LipTracker(const LipModel& model, std::span<const FaceSeen> seen, const TrackerOptions& options = {});
    ~LipTracker();

    // The pictures in order. face: where it is known, so that nothing is looked for.
    TrackedLips next(const Picture& picture, const std::optional<FaceInPicture>& face = std::nullopt);

    const Eigen::Vector3d& scale() const;  // of the model's x, y and z
    double mouth_px() const;               // width of the mouth when it was found

  private:
    class Tracking;
    std::unique_ptr<Tracking> tracking_;
};

}  // namespace viaface
