// What a stream's coder knows beforehand of a talker's via points: how each component follows from the two
// via points before and from the components already told, and how often which choice was taken. Learned from
// via points at one bound; all of it integers, as FORMAT.md has it, so that all machines predict alike.
//
// A via point is its gap from the one before, in ticks, and k values, each in steps of the stream. The
// prediction of value j is
//   (bias_j + sum_i past_ji q_i[n-1] + before_j q_j[n-2] + sum_{i<j} now_ji q_i[n]) / 4096
// with weights for each class of gap; coded is the difference from its rounding, as a choice "any at all",
// a sign, and a count in unary, each with the probability that its surroundings give.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "viapoints/range_coder.hpp"

namespace viaface {

inline constexpr int kRowClasses = 5;  // 0 to 2 by the gap before
inline constexpr int kStartClass = 3;  // the first row of a segment
inline constexpr int kStillClass = 4;  // two rows before that are the same
inline constexpr int kGapContexts =
    8;  // by the gap before: 1, 2, 3 or more ticks; 4 to 7 after rows that are the same
inline constexpr int kMostGapTicks = 64;
inline constexpr int kFirstGap = 2;  // that the first one of a segment is taken to follow
inline constexpr int kUnaryLimit = 14;
inline constexpr std::int32_t kLargestValue = 1 << 15;  // of a quantised component, either way

using ViaValues = std::vector<std::int32_t>;  // one quantised component each, in steps

int gap_class(int gap_ticks);
// Of a gap; `before` is the gap told before it.
int gap_context(int before, bool still);

// The via points that are known when one is told.
struct ViaPast {
    const ViaValues& last;    // n-1; zeros at a start
    const ViaValues& before;  // n-2; as last where there is none
    bool start, still;        // none is known; two are, and the same
};

inline ViaPast past_of(const std::vector<ViaValues>& values, std::size_t n, const ViaValues& zeros) {
    const ViaValues& last = n > 0 ? values[n - 1] : zeros;
    return {last, n > 1 ? values[n - 2] : last, n == 0, n > 1 && values[n - 2] == last};
}

inline int row_class(const ViaPast& past, int gap_ticks) {
    return past.start ? kStartClass : past.still ? kStillClass : gap_class(gap_ticks);
}

inline constexpr int kLeans = 5;

struct Prediction {
    std::int32_t nearest = 0;
    int lean =
        0;  // 0: the nearest is about right; more is likely: 1 a little, 2 much; less: 3 a little, 4 much

    std::size_t side() const { return lean == 0 ? 0 : lean < 3 ? 1 : 2; }
    std::size_t far() const { return lean == 0 ? 0 : lean % 2 == 1 ? 1 : 2; }
};

inline constexpr int kWeightBits = 12;
inline constexpr std::int64_t kWeightOne = 1 << kWeightBits;

// Of a sum in 1/4096.
inline Prediction rounded_prediction(std::int64_t sum) {
    constexpr std::int64_t kMost = kLargestValue * kWeightOne;
    sum = std::clamp(sum, -kMost, kMost);
    const std::int64_t nearest = (sum + kWeightOne / 2) >> kWeightBits;
    const std::int64_t off = sum - nearest * kWeightOne;
    const std::int64_t far = off < 0 ? -off : off;
    const int lean = far > kWeightOne / 3 ? 2 : far > kWeightOne / 6 ? 1 : 0;
    return {static_cast<std::int32_t>(nearest), lean > 0 && off < 0 ? lean + 2 : lean};
}

struct ValueContexts {
    static constexpr int kActivities = 3;
    std::array<std::array<std::array<AdaptiveBit, 3>, kActivities>, kRowClasses> any;  // by far()
    std::array<std::array<AdaptiveBit, 3>, 2> negative;                                // by side()
    std::array<std::array<AdaptiveBit, kUnaryLimit>, kActivities> more;
    std::array<AdaptiveBit, kUnaryLimit> more_still;

    auto& more_of(int row, std::size_t active) { return row == kStillClass ? more_still : more[active]; }
    const auto& more_of(int row, std::size_t active) const {
        return row == kStillClass ? more_still : more[active];
    }
};

struct GapContexts {
    std::array<std::array<AdaptiveBit, kMostGapTicks>, kGapContexts> longer;  // by what is before
};

struct StreamStatistics {
    int components = 0;
    double bound_mm = 1;                // at which they were learned
    double step_mm = 2;                 // of every component
    std::vector<std::int32_t> weights;  // [components][kRowClasses][features(j)], in 1/4096
    std::vector<ValueContexts> value;   // one per component
    GapContexts gap;
    AdaptiveBit beyond;  // of what exceeds the unary count

    static std::size_t features(int components, int j) {
        return static_cast<std::size_t>(2 + components + j);
    }
    std::size_t weights_at(int j, int row) const;
    std::int64_t prediction_sum(int j, int row, const ViaPast& past, const ViaValues& now) const;
    Prediction predict(int j, int row, const ViaPast& past, const ViaValues& now) const;
};

// Every probability, in the order of FORMAT.md.
void for_each_bit(StreamStatistics& statistics, const auto& visit) {
    const auto all = [&](auto& rows) {
        for (auto& row : rows)
            for (AdaptiveBit& bit : row) visit(bit);
    };
    for (ValueContexts& contexts : statistics.value) {
        for (auto& row : contexts.any) all(row);
        all(contexts.negative);
        all(contexts.more);
        for (AdaptiveBit& bit : contexts.more_still) visit(bit);
    }
    all(statistics.gap.longer);
    visit(statistics.beyond);
}

// Of the components of `statistics` those of `chosen` (rising; those that it lacks rarely differ from the
// last value), and as many more such ones as make `components`.
StreamStatistics with_components(const StreamStatistics& statistics, const std::vector<int>& chosen,
                                 int components);
// All of its components, or its first ones.
StreamStatistics with_components(const StreamStatistics& statistics, int components);

// Knows nothing of anybody: the last value is predicted, and all else is learned on the way.
StreamStatistics plain_statistics(int components);

// The features of value j, in the order of its weights.
void put_features(int j, const ViaPast& past, const ViaValues& now, std::vector<double>& features);

// Codes via points one after the other. Coder is RangeEncoder, RangeDecoder, or a meter: bit and even take
// the value to code and return the value coded.
template <class Coder>
class ViaCoder {
  public:
    ViaCoder(Coder& coder, StreamStatistics statistics) : coder_(coder), known_(std::move(statistics)) {}

    // 1 to at_most; at_most at least 1
    int gap(int ticks, int at_most, bool still) {
        auto& contexts = known_.gap.longer[static_cast<std::size_t>(gap_context(last_gap_, still))];
        int coded = 1;
        while (coded < at_most && coder_.bit(contexts[static_cast<std::size_t>(coded - 1)], ticks > coded))
            ++coded;
        last_gap_ = coded;
        return coded;
    }

    // A via point's values; `values` is given by an encoder and filled by a decoder.
    void values(ViaValues& values, const ViaPast& past, int gap_ticks) {
        const int row = row_class(past, gap_ticks);
        int active = 0;
        for (int j = 0; j < known_.components; ++j) {
            const Prediction predicted = known_.predict(j, row, past, values);
            const auto at = static_cast<std::size_t>(j);
            const std::int32_t rest = difference(values[at] - predicted.nearest, known_.value[at], row,
                                                 active < 2 ? active : 2, predicted);
            values[at] = predicted.nearest + rest;
            active += rest != 0;
        }
    }

    StreamStatistics& known() { return known_; }  // its contexts are those that the coder is given

  private:
    std::int32_t difference(std::int32_t wanted, ValueContexts& contexts, int row, int active,
                            const Prediction& predicted) {
        const auto a = static_cast<std::size_t>(active);
        auto& any = contexts.any[static_cast<std::size_t>(row)][a];
        if (!coder_.bit(any[predicted.far()], wanted != 0)) return 0;
        const bool negative = coder_.bit(contexts.negative[row == kStartClass][predicted.side()], wanted < 0);
        const std::int32_t size = negative ? -wanted : wanted;
        auto& more = contexts.more_of(row, a);
        std::int32_t coded = 1;
        while (coded <= kUnaryLimit && coder_.bit(more[static_cast<std::size_t>(coded - 1)], size > coded))
            ++coded;
        if (coded > kUnaryLimit)
            coded += static_cast<std::int32_t>(far(static_cast<std::uint32_t>(size - coded)));
        return negative ? -coded : coded;
    }

    // Elias gamma of value + 1, at most 17 bits
    std::uint32_t far(std::uint32_t value) {
        int bits = 0;
        while (bits < 16 && coder_.bit(known_.beyond, ((value + 1) >> bits) > 1)) ++bits;
        return (1u << bits) + coder_.even((value + 1) & ((1u << bits) - 1), bits) - 1;
    }

    Coder& coder_;
    StreamStatistics known_;
    int last_gap_ = kFirstGap;
};

}  // namespace viaface
