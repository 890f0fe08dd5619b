#include "lipmodel/known_mouth.hpp"

#include <algorithm>

namespace viaface {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kCertainty = 0.5;  // gamma, of what the maps' independence allows

}  // namespace

LipPose Placing::pose(const Vector2d& centre, double roll, double shrink, const Vector3d& scale) const {
    LipPose made;
    made.turn = {0, 0, roll};
    made.scale = scale;
    const double depth = camera.focal_px / (px_per_mm * shrink);
    const Vector2d ray = (centre - camera.centre_px) / camera.focal_px;
    made.shift = depth * Vector3d(ray.x(), ray.y(), 1) - camera_from_head(made) * lips_centre;
    return made;
}

Vector2d Placing::centre_of(const LipPose& pose) const {
    const Vector3d place = camera_from_head(pose) * lips_centre + pose.shift;
    return camera.centre_px + camera.focal_px * place.head<2>() / place.z();
}

PictureBox box_about(const Picture& picture, const Vector2d& centre, double half_width, double half_height) {
    const int left = std::clamp(static_cast<int>(centre.x() - half_width), 0, picture.width - 2),
              top = std::clamp(static_cast<int>(centre.y() - half_height), 0, picture.height - 2),
              right = std::clamp(static_cast<int>(centre.x() + half_width) + 1, left + 1, picture.width - 1),
              bottom =
                  std::clamp(static_cast<int>(centre.y() + half_height) + 1, top + 1, picture.height - 1);
    return {left, top, right - left + 1, bottom - top + 1};
}

PictureBox KnownMouth::box(const Picture& picture, const Vector2d& centre) const {
    return box_about(picture, centre, 0.95 * width_px, 0.85 * width_px);
}

ProbableLips KnownMouth::most_probable(const Picture& evened, const PictureBox& box, const LipPose& expected,
                                       const PoseFreedom& freedom,
                                       const std::vector<Eigen::VectorXd>& starts) const {
    const ClassMaps maps = class_maps(evened, box, *classes, hamming_size(width_px));
    const double gamma = kCertainty * maps.independence;
    const LipPosterior open(model, placing.camera, expected, maps, gamma, freedom),
        shut(closed.model, placing.camera, expected, maps, gamma, freedom);
    ProbableLips best;
    for (const Eigen::VectorXd& start : starts) {
        const LipFit fit = climb(open, open.start(start), ascent);
        if (fit.log_posterior > best.log_posterior)
            best = {open.modes_of(fit.theta), open.pose_of(fit.theta), fit.log_posterior,
                    open.mean_fit(fit.theta), fit.iterations};
    }
    const LipFit fit = climb(shut, shut.start(closed.nearest(best.p)), ascent);
    if (fit.log_posterior - closed.cost > best.log_posterior)
        best = {closed.modes_of(shut.modes_of(fit.theta)), shut.pose_of(fit.theta),
                fit.log_posterior - closed.cost, shut.mean_fit(fit.theta), fit.iterations};
    return best;
}

}  // namespace viaface
