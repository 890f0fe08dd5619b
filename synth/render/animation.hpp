// The frames of a film, one at a time: points -> pose -> picture -> film. Whoever speaks, renders a recording
// or receives a stream draws with it. Frame n is shown at n * denominator / numerator seconds.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <functional>
#include <optional>

#include "base/bytes.hpp"
#include "synth/film/film_writer.hpp"
#include "synth/picture/point_lights.hpp"
#include "synth/picture/portrait.hpp"
#include "synth/pose/head_sway.hpp"
#include "synth/talker/talker.hpp"

namespace viaface {

// A frame as it is drawn.
struct DrawnFrame {
    std::int64_t index = 0;
    double time_s = 0;
    Configuration commanded;  // what was asked for; NaN where it was left to the estimators
    Configuration drawn;      // off the posed mesh, after contact
};

class Animation {
  public:
    // Draws into `film`, at its rate; the points view has the markers and the lip points. `onlooker` may be
    // empty. InputError as Portrait throws it.
    Animation(const Talker& talker, const View& view, FrameRate fps, FilmWriter& film,
              std::function<void(const DrawnFrame&)> onlooker, const Drawing& drawing = {});

    // head: where head and shoulders have gone from their place in the view, mm.
    void draw(const Configuration& commanded, const Blink& blink,
              const Eigen::Isometry3d& head = Eigen::Isometry3d::Identity());
    // turn: of the head on its neck, while the eyes stay on the viewer.
    void draw(const Configuration& commanded, const Blink& blink, const HeadTurn& turn);

    std::int64_t frames() const { return frames_; }
    double time_of(std::int64_t frame) const {
        return static_cast<double>(frame * fps_.denominator) / fps_.numerator;
    }

    // Of drawn and commanded points, over all frames so far, mm.
    double rms_mm() const;
    double farthest_mm() const { return farthest_; }
    std::uint64_t motion_hash() const { return motion_hash_; }  // FNV-1a of the commanded configurations

  private:
    void add(const Configuration& commanded, const Nodes& posed, const Nodes& shown);
    FrameView picture_of(const Nodes& shown);
    void compare(const DrawnFrame& frame);

    const Talker& talker_;
    FilmWriter& film_;
    FrameRate fps_;
    std::function<void(const DrawnFrame&)> onlooker_;
    std::optional<PointLights> point_lights_;  // one of the two
    std::optional<Portrait> portrait_;
    Neck neck_;
    std::int64_t frames_ = 0, compared_ = 0;
    double squares_ = 0, farthest_ = 0;
    std::uint64_t motion_hash_ = 0;
};

}  // namespace viaface
