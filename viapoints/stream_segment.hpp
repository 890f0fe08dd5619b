// One segment of a stream: what stands in its packet, and the search for it.
#pragma once

#include "viapoints/stream_cut.hpp"
#include "viapoints/via_stream_head.hpp"

namespace viaface {

inline constexpr int kMostFiner = 8;

// A segment with its own step: the stream's, halved `finer` times.
struct SegmentVia {
    QuantisedSegment via;
    int finer = 0;
};

double step_of(const StreamHead& head, int finer);

Bytes segment_content(const StreamTools& tools, const SegmentVia& segment);
// std::runtime_error for content that is none.
SegmentVia segment_in(const StreamTools& tools, std::span<const std::uint8_t> content);

inline constexpr double kFirstRate = 15;  // via points per second that a search starts from
inline constexpr double kLiveRate = 7.5;  // likewise where time counts more than bits

// How segments are searched for: whole, or where time counts more than bits.
struct SegmentEffort {
    int rounds = 2;
    double first_rate = kFirstRate;
    bool few_modes = false;  // only modes that a segment needs take part in it, the others stay 0
};

struct RoughSegment {
    SegmentVia segment;
    bool holds = false;  // the bound
};

// Segment after segment of a motion, in order: each begins with what the one before ended with.
class SegmentEncoder {
  public:
    SegmentEncoder(const StreamTools& tools, const SegmentEffort& effort) : tools_(tools), effort_(effort) {}

    // InputError("max_error_mm", ...) when the bound cannot be held on the grid of ticks.
    SegmentVia encode(const Motion& motion, const CutSegment& cut);
    // One that follows nothing, at the stream's own step.
    RoughSegment rough(const Motion& motion, const CutSegment& cut) const;

  private:
    struct Ends {
        bool first_moves, last_moves;
    };
    Ends planned_ends(const CutSegment& cut) const;
    std::vector<int> modes_for(const Motion& motion, const CutSegment& cut) const;
    SegmentVia searched(const Motion& motion, const CutSegment& cut, const std::vector<int>& modes, int finer,
                        Ends ends) const;
    int coarsest() const;  // the least `finer` at which the segment before ends on a whole step
    ViaValues first_values(int finer) const;

    const StreamTools& tools_;
    SegmentEffort effort_;
    bool started_ = false;
    SegmentVia last_;
};

// The largest and summed squared 3-D distance of the points of the samples of a segment from those drawn.
struct SegmentError {
    double largest_mm = 0, squared_sum = 0;
};
SegmentError segment_error(const StreamTools& tools, const SegmentVia& segment, const Motion& motion,
                           const CutSegment& cut);

}  // namespace viaface
