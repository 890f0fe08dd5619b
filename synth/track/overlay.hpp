// The tracked lips drawn over the film they were tracked in: the border green, the inner edge yellow; a red
// frame where the track is lost.
#pragma once

#include "lipmodel/lip_tracker.hpp"
#include "synth/film/frame.hpp"

namespace viaface {

void draw_lips(Frame& frame, const TrackedLips& lips);

}  // namespace viaface
