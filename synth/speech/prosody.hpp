// How fast and how high a voice speaks.
#pragma once

namespace viaface {

inline constexpr double kLeast = 0.5, kMost = 2;  // of rate and of pitch

struct Prosody {
    double rate = 1;   // 0.5 to 2: of the voice's own speaking rate
    double pitch = 1;  // 0.5 to 2: of the voice's own fundamental frequency
};

// InputError("rate" or "pitch", ...) when out of range or not a number.
void check_prosody(const Prosody& prosody);

}  // namespace viaface
