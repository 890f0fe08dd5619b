// A folder of recordings as takes of one talker.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "synth/learn/codex_learning.hpp"

namespace viaface {

struct RecordedTake {
    Take take;
    double confidence = 1;  // of the alignment (synth/align/align.hpp); 1 where the phones were labelled
    bool aligned = false;   // else labelled
};

struct RecordedTakes {
    std::vector<RecordedTake> takes;  // by name; all hold the same points
    Configuration rest;  // mm: median over the takes of the points in the middle of their outer pauses
};

inline constexpr double kEndsApart = 0.25;  // s, that sound and motion may end apart
inline constexpr double kOtherScale =
    0.12;  // share that the size of a take's points there may differ from the median
// mm, that a take's points may lie from the median, in mean, in the pause before or after where they are
// nearer
inline constexpr double kOtherPlace = 6;

// One motion file as motion of the talker's points, mm, in his head frame, during which these phones are
// spoken; InputError for what is none.
using MotionReader = std::function<Motion(const std::filesystem::path&, const PhoneSequence&)>;

// Motion comes at a fixed rate of at least 20 Hz; under 50 Hz (a film's) samples are put between its own, on
// the minimum-jerk spline through them. `progress` hears a line for every take. InputError(field, ...) naming
// file and cause: what find_takes() and align() refuse, a motion without a point or with gaps, sound and
// motion that end apart, labels that do not fit, takes that hold other points than the first, or of another
// scale or place.
RecordedTakes read_takes(const std::filesystem::path& folder, const std::string& field,
                         const MotionReader& read_motion,
                         const std::function<void(const std::string&)>& progress = {});

// Throws as above for takes that do not fit together; else the rest of them all.
Configuration common_rest(const std::vector<RecordedTake>& takes, const std::string& field);

// A basis for the takes: its error, mm, holds for every second of the samples chosen from them, the others of
// which it is made.
ConfigurationBasis basis_of(const std::vector<const Take*>& takes, double error_mm);

}  // namespace viaface
