// A motion cut into the segments of a stream.
#pragma once

#include "viapoints/stream_search.hpp"

namespace viaface {

struct CutSegment {
    std::uint32_t first_tick = 0, last_tick = 0;
    std::size_t first_sample = 0, samples = 0;  // those at both ends included
    double first_speed = 0, last_speed = 0;     // mm/s, of the fastest point
};

// Segments of at most `longest` ticks; each ends, in the last fifth of that time, where the points move
// least. Times must rise; one segment at least.
std::vector<CutSegment> cut_motion(const Motion& motion, const std::vector<int>& points, int ticks_per_s,
                                   std::uint32_t longest);

// What a segment must follow: every `stride`-th sample of it, and its last one.
SegmentTarget target_of(const Motion& motion, const std::vector<int>& points, const Configuration& mean,
                        const CutSegment& cut, int ticks_per_s, std::size_t stride);

// A sample's time in ticks from the motion's first.
inline double tick_of(const Motion& motion, std::size_t sample, int ticks_per_s) {
    return (motion.time_s[sample] - motion.time_s.front()) * ticks_per_s;
}

}  // namespace viaface
