#include "viapoints/stream_cut.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "viapoints/measured.hpp"

namespace viaface {
namespace {

constexpr double kStill = 3;      // bounds per second that count as none
constexpr double kOnTick = 1e-6;  // ticks that rounding of times may be off

// Of the fastest point, mm/s.
double speed_at(const Motion& motion, const std::vector<int>& points, std::size_t sample) {
    const std::size_t a = sample > 0 ? sample - 1 : 0, b = std::min(sample + 1, motion.size() - 1);
    const RowMatrix step = coordinates_of(motion.positions.row(static_cast<Eigen::Index>(b)) -
                                              motion.positions.row(static_cast<Eigen::Index>(a)),
                                          points);
    return longest_triple(step) / (motion.time_s[b] - motion.time_s[a]);
}

// The tick in [from, to] nearest to the sample, from `sample` on, that moves least, or the last that is
// still.
std::uint32_t stillest(const Motion& motion, const StreamHead& head, std::size_t sample, std::uint32_t from,
                       std::uint32_t to) {
    double least = std::numeric_limits<double>::infinity();
    std::uint32_t best = to;
    for (std::size_t i = sample; i < motion.size(); ++i) {
        const double tick = std::round(tick_of(head, motion.time_s[i]));
        if (tick > to) break;
        if (tick < from) continue;
        const double speed = speed_at(motion, head.points, i);
        if (speed > std::max(least, kStill * head.bound_mm)) continue;
        least = std::min(least, speed);
        best = static_cast<std::uint32_t>(tick);
    }
    return best;
}

}  // namespace

CutSegment cut_at(const Motion& motion, const StreamHead& head, std::size_t first_sample,
                  std::uint32_t first_tick, std::uint32_t last_tick, bool whole) {
    const std::uint32_t earliest = last_tick - (last_tick - first_tick) / 5;
    const std::uint32_t last = whole ? last_tick : stillest(motion, head, first_sample, earliest, last_tick);
    CutSegment cut{first_tick, last, first_sample, 0, 0, 0};
    std::size_t end = first_sample;
    while (end < motion.size() && tick_of(head, motion.time_s[end]) <= last + kOnTick) ++end;
    cut.samples = end - first_sample;
    cut.first_speed = speed_at(motion, head.points, std::min(first_sample, motion.size() - 1));
    cut.last_speed = end > 0 ? speed_at(motion, head.points, end - 1) : 0;
    return cut;
}

std::vector<CutSegment> cut_motion(const Motion& motion, const StreamHead& head) {
    const double end = tick_of(head, motion.time_s.back());
    const auto total = static_cast<std::uint32_t>(std::max(1.0, std::ceil(end - kOnTick)));
    std::vector<CutSegment> cuts;
    std::size_t sample = 0;
    for (std::uint32_t first = 0; first < total;) {
        const bool whole = total - first <= head.longest_segment;
        cuts.push_back(
            cut_at(motion, head, sample, first, whole ? total : first + head.longest_segment, whole));
        first = cuts.back().last_tick;
        sample += cuts.back().samples;
        if (sample > 0 && tick_of(head, motion.time_s[sample - 1]) >= first - kOnTick) --sample;
    }
    return cuts;
}

SegmentTarget target_of(const Motion& motion, const StreamHead& head, const Configuration& mean,
                        const CutSegment& cut, std::size_t stride) {
    std::vector<std::size_t> samples;
    for (std::size_t i = 0; i < cut.samples; i += stride) samples.push_back(cut.first_sample + i);
    if (cut.samples > 0 && samples.back() != cut.first_sample + cut.samples - 1)
        samples.push_back(cut.first_sample + cut.samples - 1);
    SegmentTarget target;
    RowMatrix positions(static_cast<Eigen::Index>(samples.size()), kCoordinates);
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const double tick = tick_of(head, motion.time_s[samples[i]]) - cut.first_tick;
        target.tick.push_back(std::clamp(tick, 0.0, double(cut.last_tick - cut.first_tick)));
        positions.row(static_cast<Eigen::Index>(i)) =
            motion.positions.row(static_cast<Eigen::Index>(samples[i])) - mean.transpose();
    }
    target.points = coordinates_of(positions, head.points);
    return target;
}

}  // namespace viaface
