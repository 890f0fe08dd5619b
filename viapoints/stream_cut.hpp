// A motion cut into the segments of a stream.
#pragma once

#include "viapoints/stream_search.hpp"
#include "viapoints/via_stream_head.hpp"

namespace viaface {

struct CutSegment {
    std::uint32_t first_tick = 0, last_tick = 0;
    std::size_t first_sample = 0, samples = 0;  // those at both ends included
    double first_speed = 0, last_speed = 0;     // mm/s, of the fastest point
};

// The time in ticks of the stream.
inline double tick_of(const StreamHead& head, double time_s) {
    return (time_s - head.start_s) * head.ticks_per_s;
}

// From `first_tick`, which sample `first_sample` is the first not to lie before, to the tick of the last
// fifth before `last_tick` where the points move least, or the last one where they are still; to `last_tick`
// itself where `whole`.
CutSegment cut_at(const Motion& motion, const StreamHead& head, std::size_t first_sample,
                  std::uint32_t first_tick, std::uint32_t last_tick, bool whole);

// Segments of at most head.longest_segment ticks, the whole motion. Times must rise; one segment at least.
std::vector<CutSegment> cut_motion(const Motion& motion, const StreamHead& head);

// What a segment must follow: every `stride`-th sample of it, and its last one.
SegmentTarget target_of(const Motion& motion, const StreamHead& head, const Configuration& mean,
                        const CutSegment& cut, std::size_t stride);

}  // namespace viaface
