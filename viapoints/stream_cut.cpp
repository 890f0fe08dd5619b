#include "viapoints/stream_cut.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "viapoints/measured.hpp"

namespace viaface {
namespace {

constexpr double kOnTick = 1e-6;  // ticks that rounding of times may be off

// Of the fastest point, mm/s.
double speed_at(const Motion& motion, const std::vector<int>& points, std::size_t sample) {
    const std::size_t a = sample > 0 ? sample - 1 : 0, b = std::min(sample + 1, motion.size() - 1);
    const RowMatrix step = coordinates_of(motion.positions.row(static_cast<Eigen::Index>(b)) -
                                              motion.positions.row(static_cast<Eigen::Index>(a)),
                                          points);
    return longest_triple(step) / (motion.time_s[b] - motion.time_s[a]);
}

// The tick in [from, to] nearest to the sample that moves least.
std::uint32_t stillest(const Motion& motion, const std::vector<int>& points, int ticks_per_s,
                       std::size_t sample, std::uint32_t from, std::uint32_t to) {
    double least = std::numeric_limits<double>::infinity();
    std::uint32_t best = to;
    for (std::size_t i = sample; i < motion.size(); ++i) {
        const double tick = std::round(tick_of(motion, i, ticks_per_s));
        if (tick > to) break;
        if (tick < from) continue;
        const double speed = speed_at(motion, points, i);
        if (speed >= least) continue;
        least = speed;
        best = static_cast<std::uint32_t>(tick);
    }
    return best;
}

}  // namespace

std::vector<CutSegment> cut_motion(const Motion& motion, const std::vector<int>& points, int ticks_per_s,
                                   std::uint32_t longest) {
    const double end = tick_of(motion, motion.size() - 1, ticks_per_s);
    const auto total = static_cast<std::uint32_t>(std::max(1.0, std::ceil(end - kOnTick)));
    std::vector<CutSegment> cuts;
    std::size_t sample = 0;
    for (std::uint32_t first = 0; first < total;) {
        const std::uint32_t last = total - first <= longest
                                       ? total
                                       : stillest(motion, points, ticks_per_s, sample,
                                                  first + longest - longest / 5, first + longest);
        CutSegment cut{first, last, sample, 0, speed_at(motion, points, sample), 0};
        while (sample < motion.size() && tick_of(motion, sample, ticks_per_s) <= last + kOnTick) ++sample;
        cut.samples = sample - cut.first_sample;
        if (sample > 0) cut.last_speed = speed_at(motion, points, sample - 1);
        cuts.push_back(cut);
        if (sample > 0 && tick_of(motion, sample - 1, ticks_per_s) >= last - kOnTick) --sample;
        first = last;
    }
    return cuts;
}

SegmentTarget target_of(const Motion& motion, const std::vector<int>& points, const Configuration& mean,
                        const CutSegment& cut, int ticks_per_s, std::size_t stride) {
    std::vector<std::size_t> samples;
    for (std::size_t i = 0; i < cut.samples; i += stride) samples.push_back(cut.first_sample + i);
    if (cut.samples > 0 && samples.back() != cut.first_sample + cut.samples - 1)
        samples.push_back(cut.first_sample + cut.samples - 1);
    SegmentTarget target;
    RowMatrix positions(static_cast<Eigen::Index>(samples.size()), kCoordinates);
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const double tick = tick_of(motion, samples[i], ticks_per_s) - cut.first_tick;
        target.tick.push_back(std::clamp(tick, 0.0, double(cut.last_tick - cut.first_tick)));
        positions.row(static_cast<Eigen::Index>(i)) =
            motion.positions.row(static_cast<Eigen::Index>(samples[i])) - mean.transpose();
    }
    target.points = coordinates_of(positions, points);
    return target;
}

}  // namespace viaface
