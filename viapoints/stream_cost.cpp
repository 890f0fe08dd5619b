#include "viapoints/stream_cost.hpp"

#include <algorithm>
#include <cmath>

namespace viaface {
namespace {

constexpr double kNoSuchGap = 1000;  // bits
constexpr int kFurthest = 40;        // differences beyond it cost by their length

double difference_bits(const ValueContexts& contexts, int row, std::size_t active,
                       const Prediction& predicted, int v) {
    double bits = bits_of(contexts.any[static_cast<std::size_t>(row)][active][predicted.far()].one, v != 0);
    if (v == 0) return bits;
    bits += bits_of(contexts.negative[row == kStartClass][predicted.side()].one, v < 0);
    const auto& more = contexts.more_of(row, active);
    const int size = std::abs(v);
    for (int n = 1; n <= std::min(size, kUnaryLimit); ++n)
        bits += bits_of(more[static_cast<std::size_t>(n - 1)].one, size > n);
    if (size > kUnaryLimit) bits += 1;
    return bits;
}

// What a difference costs beyond the smallest one that is not told in unary.
double far_bits(int size) {
    const int known = std::min(size, kFurthest);
    return 2 * std::log2(known - kUnaryLimit) + 0.2 * (size - known);
}

}  // namespace

StreamCost::StreamCost(const StreamStatistics& statistics) : statistics_(statistics) {
    const int n = statistics.components;
    now_.assign(static_cast<std::size_t>(kRowClasses * n * n), 0);
    last_ = now_;
    before_.assign(static_cast<std::size_t>(kRowClasses * n), 0);
    for (int j = 0; j < n; ++j) {
        for (int row = 0; row < kRowClasses; ++row) {
            const std::int32_t* w = statistics.weights.data() + statistics.weights_at(j, row) + 1;
            for (int k = 0; k < n; ++k) last_[static_cast<std::size_t>((row * n + k) * n + j)] = *w++;
            before_[static_cast<std::size_t>(row * n + j)] = *w++;
            for (int k = 0; k < j; ++k) now_[static_cast<std::size_t>((row * n + k) * n + j)] = *w++;
        }
    }
    for (int row = 0; row < kRowClasses; ++row)
        for (int j = 0; j < n; ++j)
            for (std::size_t a = 0; a < 3; ++a)
                for (int lean = 0; lean < kLeans; ++lean)
                    for (int v = -kLookedUp; v <= kLookedUp; ++v)
                        difference_.push_back(static_cast<float>(difference_bits(
                            statistics.value[static_cast<std::size_t>(j)], row, a, {0, lean}, v)));
    for (std::size_t c = 0; c < kGapContexts; ++c) {
        double longer = 0;
        gap_.push_back(0);
        for (std::size_t t = 1; t <= kMostGapTicks; ++t) {
            const std::uint16_t one = statistics.gap.longer[c][t - 1].one;
            gap_.push_back(longer + bits_of(one, false));
            longer += bits_of(one, true);
        }
    }
}

double StreamCost::gap(int context, int ticks) const {
    if (ticks > kMostGapTicks) return kNoSuchGap;
    return gap_[static_cast<std::size_t>(context * (kMostGapTicks + 1) + ticks)];
}

double StreamCost::values(int row, const PredictionSums& sums, const ViaValues& values) const {
    constexpr int kSide = 2 * kLookedUp + 1, kActive = kLeans * kSide, kValue = 3 * kActive;
    double bits = 0;
    int active = 0;
    const float* table = difference_.data() + row * components() * kValue;
    for (std::size_t k = 0; k < values.size(); ++k, table += kValue) {
        const Prediction predicted = rounded_prediction(sums[k]);
        const std::int32_t rest = values[k] - predicted.nearest;
        const std::int32_t v = std::clamp(rest, -kLookedUp, kLookedUp);
        bits += static_cast<double>(table[active * kActive + predicted.lean * kSide + v + kLookedUp]);
        if (rest != v) bits += far_bits(std::abs(rest));
        if (rest != 0 && active < 2) ++active;
    }
    return bits;
}

void StreamCost::predict(int row, const ViaPast& past, const ViaValues& now, PredictionSums& sums) const {
    sums.resize(now.size());
    for (int k = 0; k < components(); ++k)
        sums[static_cast<std::size_t>(k)] = statistics_.prediction_sum(k, row, past, now);
}

void StreamCost::add_now(int row, int k, std::int64_t by, PredictionSums& sums) const {
    const std::int64_t* w = of(now_, row, k);
    for (std::size_t j = static_cast<std::size_t>(k) + 1; j < sums.size(); ++j) sums[j] += by * w[j];
}

void StreamCost::add_last(int row, int k, std::int64_t by, PredictionSums& sums) const {
    const std::int64_t* w = of(last_, row, k);
    for (std::size_t j = 0; j < sums.size(); ++j) sums[j] += by * w[j];
}

void StreamCost::add_before(int row, int k, std::int64_t by, PredictionSums& sums) const {
    sums[static_cast<std::size_t>(k)] += by * before_[static_cast<std::size_t>(row * components() + k)];
}

}  // namespace viaface
