// Gaps in a recording: runs of samples where a point was not measured. A gap no longer than a limit is
// bridged by the minimum-jerk spline through six neighbours, the sample next to the gap and two farther out
// on either side; one at the beginning or the end holds the nearest place. A longer one is refused, or left.
// A point that was never measured has no gap: it is not there.
#pragma once

#include <string>
#include <vector>

#include "viapoints/point_recording.hpp"

namespace viaface {

struct Gap {
    std::string label;
    double from_s = 0, to_s = 0;  // the samples next to it, or the recording's end
    bool bridged = false;

    double length_s() const { return to_s - from_s; }
};

enum class LongGaps { kRefuse, kLeave };

// The gaps, bridged in `recording` up to longest_s. InputError(field, ...) naming a longer one when refused.
std::vector<Gap> bridge_gaps(PointRecording& recording, double longest_s, LongGaps longer,
                             const std::string& field = "motion");

}  // namespace viaface
