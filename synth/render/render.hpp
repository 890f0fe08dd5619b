// A recorded motion into a film, at any rate of either: the report's animation straight from position
// [ATR98, "Animation"]. The film begins at a time of the motion's own clock; the sound given begins there
// too, and picture and sound end within a frame of each other. Between samples the motion runs on as
// motion_at.hpp says; points that are missing are estimated from those that are there. Recorded blinks (extra
// columns eyeBlink_L, eyeBlink_R) shut the lids; without them blinks are drawn by the seed.
#pragma once

#include <optional>
#include <vector>

#include "synth/motion/motion_input.hpp"
#include "synth/render/animation.hpp"

namespace viaface {

struct RenderRequest {
    View view;
    Drawing drawing = {};
    FrameRate fps;
    std::uint64_t seed = 1;           // of the blinks
    double from_s = 0;                // of the motion's clock
    std::optional<double> to_s = {};  // else the later end of motion and sound
    bool keep_head = false;           // MotionInput::head turns the head in the view
};

struct Sound {
    int sample_rate = 48000;                 // Hz
    std::vector<std::int16_t> samples = {};  // from time 0 of the motion's clock
};

struct RenderReport {
    std::int64_t frames = 0;
    double rms_mm = 0, farthest_mm = 0;  // of drawn and commanded points that were there
    std::uint64_t motion_hash = 0;       // FNV-1a of the commanded configurations
};

// Adds all frames and sound to `film` and finishes it. InputError("--from") or ("--to") for a time span in
// which there is nothing, InputError("motion") for a time without any point.
RenderReport render(const RenderRequest& request, const MotionInput& moving, const Sound& sound,
                    const Talker& talker, FilmWriter& film,
                    const std::function<void(const DrawnFrame&)>& onlooker = {});

}  // namespace viaface
