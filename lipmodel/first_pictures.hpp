// A talker's mouth learned from the first pictures: scales and colour classes are fitted in turns, the
// model's own regions give samples, the classes a posterior, its maximum new regions. A sample whose colour
// another class fits far better is left out, or the classes would drift into each other.
#pragma once

#include "lipmodel/known_mouth.hpp"
#include "lipmodel/mouth_finder.hpp"

namespace viaface {

struct FaceSeen {
    Picture picture;
    FaceInPicture face;
    std::optional<MouthInPicture> mouth = {};  // where it is given by hand; else found
};

struct TrackerOptions {
    double eye_distance_mm = 63;  // the scale: between the pupils
    AscentOptions ascent = {.iterations = 19};
};

// How far a pose may be from the one that a face's place alone suggests.
inline constexpr PoseFreedom kFirstFreedom{.turn = 0.03, .shift = 3, .scale = 0.1};

double roll_of(const FaceInPicture& face);

// std::invalid_argument without pictures; InputError("video", ...) when the mouth is too small or cannot be
// told from the skin.
KnownMouth learn_mouth(const LipModel& model, std::span<const FaceSeen> seen, const TrackerOptions& options);

}  // namespace viaface
