// Chosen units to the via points of a sentence, on the sample clock; MinimumJerkSpline with both ends at rest
// does the rest.
//
// A phone's via points keep their places relative to it. A pause keeps its unit's pace instead: its movement
// lies against the speech that it follows or leads to, compressed only where the pause is shorter than the
// unit, and a pause that outlasts its unit by kRestReach is at rest there. The sentence begins and ends at
// rest; a first or last pause under kRestReach is widened outwards to it, so the track may begin before the
// sound and end after it. Via points that come too close where units meet are thinned (a closure is kept as
// it is), and gaps too uneven are graded with points of the monotone cubic.
#pragma once

#include "viapoints/codex_select.hpp"

namespace viaface {

inline constexpr double kRestReach = 0.150;  // s

// Components; at least two via points. Begins and ends with the posture at rest, to be splined with
// SplineEnd::at_rest().
ViaPointTrack speak(const Codex& codex, const PhoneSequence& phones, const Selection& selection);

}  // namespace viaface
