#include "synth/picture/point_lights.hpp"

#include <Eigen/Geometry>

#include "synth/picture/background.hpp"
#include "synth/picture/strokes.hpp"

namespace viaface {
namespace {

constexpr Rgb kWhite{255, 255, 255};

}  // namespace

PointLights::PointLights(const View& view) : view_(view) {
    const Camera camera = camera_of(view);
    clip_from_head_ = camera.clip_from_world * camera.world_from_head;
    radius_ = static_cast<float>(std::max(kSmallest, kRadius / pixel_size(view)));
    background_ = make_background(view).pixels;
}

FrameView PointLights::draw(std::span<const Eigen::Vector3d> places) {
    rgba_ = background_;
    const Canvas canvas{view_.width, view_.height, rgba_.data()};
    const Eigen::Vector2f half(0.5f * view_.width, 0.5f * view_.height);
    for (const Eigen::Vector3d& place : places) {
        const Eigen::Vector4d clip = clip_from_head_ * place.homogeneous();
        if (!clip.allFinite() || clip.w() <= 0) continue;
        const Eigen::Vector2f at = ((clip.head<2>() / clip.w()).array() + 1).cast<float>() * half.array();
        for_pixels_near(canvas, at, at, radius_ + 0.5f, [&](int x, int y, float distance, float) {
            canvas.lay(x, y, kWhite, std::min(1.0f, radius_ + 0.5f - distance));
        });
    }
    return bottom_up_view(view_.width, view_.height, rgba_.data());
}

}  // namespace viaface
