// A performance recorded as weights of named blend shapes over time, as face trackers on phones and animators
// give it; retarget.hpp makes a Motion of it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "viapoints/motion.hpp"

namespace viaface {

struct BlendRecording {
    static constexpr double kLargestWeight = 10;  // either way; more is no weight

    std::vector<double> time_s;      // strictly rising, from 0
    std::vector<std::string> names;  // of the shapes
    RowMatrix weights;               // [frames x shapes], 1 is the whole shape; NaN where not tracked
    std::vector<ExtraColumn> extra;  // what is recorded beside: turns of head and eyes
};

// A .npy (facegood.hpp) by its first bytes, else a Live Link Face CSV (live_link.hpp).
BlendRecording read_blend_recording(const std::filesystem::path& path, const std::string& field = "motion");

}  // namespace viaface
