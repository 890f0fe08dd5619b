// The face at rest in a recording: the 0.2 s of least speed (rms over the points) among those in which the
// lips are as close as in a quarter of the recording and every point is measured; where times are known at
// which nobody speaks, among those within them if there is one; or a time that is given.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "viapoints/motion.hpp"

namespace viaface {

using TimeSpan = std::pair<double, double>;  // from, to, s

struct Rest {
    Configuration points;  // mean over the time, in the motion's axes
    double from_s = 0, to_s = 0;
};

// InputError("--rest", ...) when it cannot be found, or the time given lacks samples or a point.
Rest rest_of(const Motion& motion, const std::optional<TimeSpan>& given_s = {},
             const std::vector<TimeSpan>& quiet_s = {});

}  // namespace viaface
