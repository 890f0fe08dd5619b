// The whole way: a script spoken by a talker into a film. One frame is held at a time, one sentence at a
// time. The sample clock is the only clock: sentence s begins at the sum of the samples before it, frame n is
// shown at n * denominator / numerator seconds.
#pragma once

#include <array>
#include <cstdint>
#include <functional>

#include "base/bytes.hpp"
#include "synth/film/film_writer.hpp"
#include "synth/picture/portrait.hpp"
#include "synth/render/animation.hpp"
#include "synth/say/recital.hpp"
#include "synth/talker/talker.hpp"

namespace viaface {

struct SayRequest {
    SpeechRequest speech;
    View view;
    FrameRate fps;
    std::uint64_t seed = 1;  // of the blinks and of the head's motion
    double head_motion = 0;  // degrees, 0 to HeadSway::kWidest: how far the head turns by itself
    Renderer renderer = Renderer::kRaster;
};

// Who looks on; empty ones are not called. All are called from the thread that calls say().
struct Onlookers {
    std::function<void(const DrawnFrame&)> frame = {};
    std::function<void(const Recital&, std::int64_t first_sample)> recital = {};
    std::function<void(double share_done)> progress = {};  // by sentences
};

struct SayReport {
    std::int64_t samples = 0;
    int sample_rate = 16000;
    std::int64_t frames = 0;
    std::array<int, 3> phones_at_level = {};  // exact, class, half
    double rms_mm = 0, farthest_mm = 0;       // of drawn and commanded, over all points and frames
    std::uint64_t sound_hash = 0,
                  motion_hash = 0;  // FNV-1a of the samples and of the commanded configurations
};

// Adds all frames and all sound to `film` and finishes it. InputError as Script, View and FilmSpec throw it.
SayReport say(const SayRequest& request, const Talker& talker, FilmWriter& film,
              const Onlookers& onlookers = {});

}  // namespace viaface
