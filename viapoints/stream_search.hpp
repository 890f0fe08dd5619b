// The search for the via points of one segment of a stream: times on a grid and whole numbers of steps with
// which the minimum-jerk spline (natural ends) keeps every point within the bound at every sample, at few
// bits. No closed form is known for a maximum-norm lattice problem of this size; here
// 1. via points are taken as given, fitted by least squares and rounded;
// 2. one value after the other is moved by one step as long as that lowers bits + penalty * excess over the
//    bound, first with values free to leave the bound a little, then until nothing exceeds it;
// 3. via points are taken out, moved in time or put in where, after step 2 in their neighbourhood, the whole
//    costs fewer bits.
// Bits are those of the statistics as they stand, without what is learned on the way.
#pragma once

#include "viapoints/stream_spline.hpp"
#include "viapoints/stream_statistics.hpp"
#include "viapoints/track.hpp"

namespace viaface {

struct SegmentTarget {
    std::vector<double> tick;  // of each sample, rising from 0 or more to the segment's length
    RowMatrix points;          // [samples x 3 points], mm from the basis's mean
};

struct QuantisedSegment {
    std::vector<int> tick;          // of each via point; from 0, rising; ends that move stand three times
    std::vector<ViaValues> values;  // control values, one for each time

    int length() const { return tick.back(); }
};

// Codes the segment's via points; its length and which ends move are told apart.
template <class Coder>
void code_segment(ViaCoder<Coder>& coder, const QuantisedSegment& segment) {
    const ViaValues zeros(segment.values[0].size());
    for (std::size_t n = 0; n < segment.tick.size(); ++n) {
        const ViaPast past = past_of(segment.values, n, zeros);
        int gap = 0;
        if (n > 0 && segment.tick[n] != segment.tick[n - 1])
            gap = coder.gap(segment.tick[n] - segment.tick[n - 1],
                            std::min(kMostGapTicks, segment.length() - segment.tick[n - 1]), past.still);
        ViaValues values = segment.values[n];
        coder.values(values, past, gap);
    }
}

struct SearchOptions {
    double bound_mm = 1;
    double step_mm = 2;
    int rounds = 2;  // of step 3
};

// `modes` [3 points x k]. `first` fixes the first via point's values unless it is empty. The result may still
// exceed the bound where the grid or the basis do not allow better: the caller checks.
QuantisedSegment search_segment(const SegmentTarget& target, const Eigen::MatrixXd& modes,
                                const StreamStatistics& statistics, std::vector<int> ticks,
                                const ViaValues& first, const SearchOptions& options);

// The segment's spline at ticks: [ticks x k], mm.
RowMatrix components_at(const QuantisedSegment& segment, double step_mm, const std::vector<double>& ticks);

}  // namespace viaface
