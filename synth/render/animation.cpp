#include "synth/render/animation.hpp"

#include <array>
#include <cmath>

namespace viaface {

Animation::Animation(const Talker& talker, const View& view, FrameRate fps, FilmWriter& film,
                     std::function<void(const DrawnFrame&)> onlooker, const Drawing& drawing)
    : talker_(talker), film_(film), fps_(fps), onlooker_(std::move(onlooker)), neck_(talker.face) {
    if (view.shown == Shown::kPoints) {
        point_lights_.emplace(view);
    } else {
        portrait_.emplace(talker.face, view, drawing);
    }
}

void Animation::draw(const Configuration& commanded, const Blink& blink, const Eigen::Isometry3d& head) {
    const Nodes posed = talker_.poser.posed(commanded, blink);
    if (head.isApprox(Eigen::Isometry3d::Identity())) return add(commanded, posed, posed);
    add(commanded, posed, (posed * head.linear().transpose()).rowwise() + head.translation().transpose());
}

void Animation::draw(const Configuration& commanded, const Blink& blink, const HeadTurn& turn) {
    const Nodes posed = talker_.poser.posed(commanded, blink, {-turn.left, -turn.up});
    Nodes shown = posed;
    neck_.turn(shown, turn);
    add(commanded, posed, shown);
}

void Animation::add(const Configuration& commanded, const Nodes& posed, const Nodes& shown) {
    const DrawnFrame frame{frames_, time_of(frames_), commanded, talker_.poser.drawn_points(posed)};
    film_.add_frame(picture_of(shown));
    compare(frame);
    motion_hash_ =
        fnv1a({reinterpret_cast<const std::uint8_t*>(commanded.data()), kCoordinates * sizeof(double)},
              motion_hash_);
    if (onlooker_) onlooker_(frame);
    ++frames_;
}

FrameView Animation::picture_of(const Nodes& shown) {
    if (portrait_) return portrait_->draw(shown);
    const Configuration points = talker_.poser.drawn_points(shown);
    std::array<Eigen::Vector3d, kFaceMarkers + kLipPoints> places;
    for (int p = 0; p < int(places.size()); ++p) places[p] = point_of(points, p);
    return point_lights_->draw(places);
}

void Animation::compare(const DrawnFrame& frame) {
    const Configuration apart = frame.drawn - frame.commanded;
    for (int point = 0; point < kPoints; ++point) {
        const double squared = point_of(apart, point).squaredNorm();
        if (std::isnan(squared)) continue;
        squares_ += squared;
        ++compared_;
        farthest_ = std::max(farthest_, std::sqrt(squared));
    }
}

double Animation::rms_mm() const {
    return compared_ == 0 ? 0 : std::sqrt(squares_ / static_cast<double>(compared_));
}

}  // namespace viaface
