// In which modes a stream tells a motion: the talker's, blends of them, directions within them, or the
// motion's own. What each costs is tried on the few seconds in which the points go furthest.
#pragma once

#include "viapoints/stream_model.hpp"
#include "viapoints/via_stream_head.hpp"

namespace viaface {

// A head, basis and statistics from a model, for motion of `points` under a bound, in `modes` of it (rising),
// blends of the others, and directions. InputError("talker", ...) for a point that the model lacks.
StreamTools shared_tools(const StreamModel& model, std::vector<int> points, double max_error_mm,
                         std::vector<int> modes, BlendWeights blends = {}, StreamDirections directions = {});

struct ChosenTools {
    StreamTools tools;
    bool holds = false;  // the bound was kept on the grid of ticks where it was tried
};

// `model` may be null: then the basis is the motion's own. At most sync_s seconds a segment.
ChosenTools chosen_tools(const Motion& motion, const StreamModel* model, double max_error_mm, double sync_s,
                         int ticks_per_s);

}  // namespace viaface
