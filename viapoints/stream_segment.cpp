#include "viapoints/stream_segment.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/error.hpp"
#include "viapoints/measured.hpp"
#include "viapoints/stream_basis.hpp"

namespace viaface {
namespace {

using Eigen::Index;

constexpr double kSearchedRate = 60;  // samples per second that a search looks at first
constexpr double kRestingSpeed = 30;  // bounds per second: what moves slower at an end may rest there
constexpr double kNearly = 1.5;       // bounds that other ends may bring within one
constexpr int kFinerBits = 3;
constexpr std::uint16_t kFinerAtAll = 2048, kEndMoves = 16384, kEndsEarly = 8192;  // of 65536
constexpr int kMostNarrower = 3;  // times that the bound is drawn in for samples in between

Eigen::MatrixXd packed_modes(const StreamTools& tools) {
    return coordinates_of(tools.basis.modes.transpose(), tools.head.points).transpose();
}

// Even via times.
std::vector<int> first_ticks(const StreamHead& head, const CutSegment& cut, bool first_moves, bool last_moves,
                             double rate) {
    const auto length = static_cast<int>(cut.last_tick - cut.first_tick);
    const int gap = std::max(1, static_cast<int>(std::lround(head.ticks_per_s / rate)));
    std::vector<int> ticks(first_moves ? 3 : 1);
    for (int tick = gap; tick < length; tick += gap) ticks.push_back(tick);
    ticks.insert(ticks.end(), last_moves ? 3 : 1, length);
    return ticks;
}

std::size_t stride_of(const Motion& motion, const CutSegment& cut) {
    if (cut.samples < 2) return 1;
    const double seconds =
        motion.time_s[cut.first_sample + cut.samples - 1] - motion.time_s[cut.first_sample];
    return static_cast<std::size_t>(
        std::max(1.0, std::floor(static_cast<double>(cut.samples - 1) / (seconds * kSearchedRate))));
}

bool divisible(const ViaValues& values, int by) {
    return std::all_of(values.begin(), values.end(), [by](std::int32_t v) { return v % by == 0; });
}

// What a packet tells before its via points.
struct Front {
    int finer = 0;
    bool first_moves = false, last_moves = false;
    std::uint32_t length = 1;  // ticks
};

template <class Coder>
Front code_front(Coder& coder, Front front, std::uint32_t longest) {
    AdaptiveBit finer{kFinerAtAll}, first{kEndMoves}, last{kEndMoves}, early{kEndsEarly};
    if (coder.bit(finer, front.finer != 0))
        front.finer =
            1 + static_cast<int>(coder.even(static_cast<std::uint32_t>(front.finer - 1), kFinerBits));
    front.first_moves = coder.bit(first, front.first_moves);
    front.last_moves = coder.bit(last, front.last_moves);
    const std::uint32_t fifth = longest / 5, left = longest - front.length;
    if (coder.bit(early, left > fifth))
        front.length = coder.even(front.length, std::bit_width(longest));
    else
        front.length = longest - coder.even(left, std::bit_width(fifth));
    return front;
}

ViaValues of_modes(const ViaValues& values, const std::vector<int>& modes) {
    ViaValues few;
    for (const int mode : modes)
        if (!values.empty()) few.push_back(values[static_cast<std::size_t>(mode)]);
    return few;
}

// Modes that took no part stay 0.
QuantisedSegment in_all_modes(QuantisedSegment segment, const std::vector<int>& modes, std::size_t all) {
    for (ViaValues& values : segment.values) {
        ViaValues whole(all);
        for (std::size_t i = 0; i < modes.size(); ++i) whole[static_cast<std::size_t>(modes[i])] = values[i];
        values = std::move(whole);
    }
    return segment;
}

}  // namespace

double step_of(const StreamHead& head, int finer) { return std::ldexp(head.step_mm, -finer); }

Bytes segment_content(const StreamTools& tools, const SegmentVia& segment) {
    RangeEncoder encoder;
    code_front(encoder,
               {segment.finer, moves_first(segment.via.tick), moves_last(segment.via.tick),
                static_cast<std::uint32_t>(segment.via.length())},
               tools.head.longest_segment);
    ViaCoder<RangeEncoder> coder(encoder, tools.statistics);
    code_segment(coder, segment.via);
    return encoder.finish();
}

SegmentVia segment_in(const StreamTools& tools, std::span<const std::uint8_t> content) {
    RangeDecoder decoder(content);
    SegmentVia segment;
    const Front front = code_front(decoder, {}, tools.head.longest_segment);
    segment.finer = front.finer;
    const std::size_t at_first = front.first_moves ? 3 : 1, at_last = front.last_moves ? 3 : 1;
    if (front.length < 1 || front.length > tools.head.longest_segment)
        throw std::runtime_error("a segment of " + std::to_string(front.length) + " ticks");
    const auto length = static_cast<int>(front.length);
    ViaCoder<RangeDecoder> coder(decoder, tools.statistics);
    QuantisedSegment& via = segment.via;
    const ViaValues zeros(static_cast<std::size_t>(tools.basis.size()));
    for (std::size_t ends = 0; ends < at_last;) {
        int ticks = 0;
        const ViaPast past = past_of(via.values, via.values.size(), zeros);
        if (via.tick.size() >= at_first && ends == 0)
            ticks = coder.gap(0, std::min(kMostGapTicks, length - via.tick.back()), past.still);
        via.tick.push_back(via.tick.empty() ? 0 : via.tick.back() + ticks);
        ViaValues values = zeros;
        coder.values(values, past, ticks);
        if (std::any_of(values.begin(), values.end(),
                        [](std::int32_t v) { return std::abs(v) > kLargestValue; }))
            throw std::runtime_error("a value out of range");
        via.values.push_back(std::move(values));
        ends += via.tick.back() == length;
    }
    return segment;
}

SegmentError segment_error(const StreamTools& tools, const SegmentVia& segment, const Motion& motion,
                           const CutSegment& cut) {
    const SegmentTarget target = target_of(motion, tools.head, tools.basis.mean, cut, 1);
    if (target.tick.empty()) return {};
    const RowMatrix off = components_at(segment.via, step_of(tools.head, segment.finer), target.tick) *
                              packed_modes(tools).transpose() -
                          target.points;
    return {longest_triple(off), off.squaredNorm()};
}

ViaValues SegmentEncoder::first_values(int finer) const {
    if (!started_) return {};
    ViaValues values = last_.via.values.back();
    for (std::int32_t& v : values)
        v = finer >= last_.finer ? v * (1 << (finer - last_.finer)) : v / (1 << (last_.finer - finer));
    return values;
}

// Those that the segment needs or begins with, or all.
std::vector<int> SegmentEncoder::modes_for(const Motion& motion, const CutSegment& cut) const {
    std::vector<int> modes(static_cast<std::size_t>(tools_.basis.size()));
    std::iota(modes.begin(), modes.end(), 0);
    if (!effort_.few_modes || cut.samples == 0) return modes;
    const RowMatrix positions =
        motion.positions.middleRows(static_cast<Index>(cut.first_sample), static_cast<Index>(cut.samples));
    std::vector<int> few =
        needed_modes(tools_.basis, tools_.head.points, positions, kBasisShare * tools_.head.bound_mm);
    if (few.empty()) few.push_back(0);
    const ViaValues first = first_values(last_.finer);
    std::erase_if(modes, [&](int mode) {
        return !std::binary_search(few.begin(), few.end(), mode) &&
               (first.empty() || first[static_cast<std::size_t>(mode)] == 0);
    });
    return modes;
}

SegmentVia SegmentEncoder::searched(const Motion& motion, const CutSegment& cut,
                                    const std::vector<int>& modes, int finer, Ends ends) const {
    SegmentVia found{{}, finer};
    SearchOptions options{tools_.head.bound_mm, step_of(tools_.head, finer), effort_.rounds};
    const std::vector<int> ticks =
        first_ticks(tools_.head, cut, ends.first_moves, ends.last_moves, effort_.first_rate);
    const StreamStatistics statistics =
        with_components(tools_.statistics, modes, static_cast<int>(modes.size()));
    const Eigen::MatrixXd packed = packed_modes(tools_)(Eigen::all, modes);
    const ViaValues first = of_modes(first_values(finer), modes);
    std::size_t stride = stride_of(motion, cut);
    for (int tries = 0;; ++tries) {
        const SegmentTarget target = target_of(motion, tools_.head, tools_.basis.mean, cut, stride);
        found.via = in_all_modes(search_segment(target, packed, statistics, ticks, first, options), modes,
                                 static_cast<std::size_t>(tools_.basis.size()));
        if (stride == 1 || segment_error(tools_, found, motion, cut).largest_mm <= tools_.head.bound_mm)
            return found;
        options.bound_mm *= 0.97;
        if (tries == kMostNarrower) {
            options.bound_mm = tools_.head.bound_mm;
            stride = 1;
        }
    }
}

int SegmentEncoder::coarsest() const {
    if (!started_) return 0;
    int finer = last_.finer;
    while (finer > 0 && divisible(last_.via.values.back(), 1 << (last_.finer - finer + 1))) --finer;
    return finer;
}

SegmentEncoder::Ends SegmentEncoder::planned_ends(const CutSegment& cut) const {
    const auto moves = [&](double speed) { return speed > kRestingSpeed * tools_.head.bound_mm; };
    return {started_ ? moves_last(last_.via.tick) : moves(cut.first_speed), moves(cut.last_speed)};
}

RoughSegment SegmentEncoder::rough(const Motion& motion, const CutSegment& cut) const {
    const std::vector<int> modes = modes_for(motion, cut);
    RoughSegment found;
    for (const Ends ends : {planned_ends(cut), Ends{true, true}}) {
        found.segment = searched(motion, cut, modes, 0, ends);
        const double error = segment_error(tools_, found.segment, motion, cut).largest_mm;
        found.holds = error <= tools_.head.bound_mm;
        if (found.holds || error > kNearly * tools_.head.bound_mm) break;
    }
    return found;
}

SegmentVia SegmentEncoder::encode(const Motion& motion, const CutSegment& cut) {
    const Ends planned = planned_ends(cut);
    const int first = coarsest();
    double least = std::numeric_limits<double>::infinity();
    std::vector<int> modes = modes_for(motion, cut);
    const auto holds = [&](int finer, Ends ends, SegmentVia& found) {
        found = searched(motion, cut, modes, finer, ends);
        const double error =
            segment_error(tools_, segment_in(tools_, segment_content(tools_, found)), motion, cut).largest_mm;
        least = std::min(least, error);
        return error <= tools_.head.bound_mm;
    };
    SegmentVia found;
    bool held = holds(first, planned, found);
    if (!held && modes.size() < static_cast<std::size_t>(tools_.basis.size())) {
        modes.resize(static_cast<std::size_t>(tools_.basis.size()));
        std::iota(modes.begin(), modes.end(), 0);
        held = holds(first, planned, found);
    }
    for (int finer = first; !held && finer <= kMostFiner; ++finer) held = holds(finer, {true, true}, found);
    if (!held)
        throw InputError("max_error_mm", std::to_string(tools_.head.bound_mm),
                         "what " + std::to_string(tools_.head.ticks_per_s) +
                             " via points per second can hold: " + std::to_string(least) + " is reached at " +
                             std::to_string(motion.time_s[cut.first_sample]) + " s");
    started_ = true;
    return last_ = std::move(found);
}

}  // namespace viaface
