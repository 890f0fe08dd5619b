#include "viapoints/stream_cost.hpp"

#include <algorithm>
#include <cmath>

namespace viaface {

StreamCost::StreamCost(const StreamStatistics& statistics) : statistics_(statistics) {
    for (int j = 0; j < statistics.components; ++j) {
        const ValueContexts& contexts = statistics.value[static_cast<std::size_t>(j)];
        for (std::size_t c = 0; c < kGapClasses; ++c)
            for (std::size_t a = 0; a < 3; ++a)
                for (std::size_t s = 0; s < 3; ++s)
                    for (int v = -kFurthest; v <= kFurthest; ++v) {
                        double bits = bits_of(contexts.any[c][a].one, v != 0);
                        if (v != 0) {
                            bits += bits_of(contexts.negative[c == kStartClass][s].one, v < 0);
                            const int size = std::abs(v);
                            for (int n = 1; n <= std::min(size, kUnaryLimit); ++n)
                                bits +=
                                    bits_of(contexts.more[a][static_cast<std::size_t>(n - 1)].one, size > n);
                            if (size > kUnaryLimit) bits += 2 * std::log2(size - kUnaryLimit) + 1;
                        }
                        difference_.push_back(static_cast<float>(bits));
                    }
    }
    for (std::size_t c = 0; c < 3; ++c) {
        double longer = 0;
        gap_.push_back(0);
        for (std::size_t n = 1; n <= kMostGapTicks; ++n) {
            const std::uint16_t one = statistics.gap.longer[c][n - 1].one;
            gap_.push_back(longer + bits_of(one, false));
            longer += bits_of(one, true);
        }
    }
}

double StreamCost::gap(int class_before, int ticks) const {
    return gap_[static_cast<std::size_t>(class_before * (kMostGapTicks + 1) +
                                         std::min(ticks, kMostGapTicks))] +
           (ticks > kMostGapTicks ? 1000 : 0);
}

double StreamCost::difference(int component, int gap_class, int active, int side, std::int32_t value) const {
    const std::int32_t v = std::clamp(value, -kFurthest, kFurthest);
    const int at = (((component * kGapClasses + gap_class) * 3 + active) * 3 + side) * (2 * kFurthest + 1) +
                   v + kFurthest;
    return static_cast<double>(difference_[static_cast<std::size_t>(at)]) + 0.2 * std::abs(value - v);
}

double StreamCost::event(const std::vector<int>& ticks, const std::vector<ViaValues>& values,
                         std::size_t j) const {
    const ViaValues zeros(j == 0 ? values[0].size() : 0);
    const ViaPast past = past_of(values, j, zeros);
    const int c = j > 0 ? gap_class(ticks[j] - ticks[j - 1]) : kStartClass;
    double bits =
        j > 0 && ticks[j] != ticks[j - 1]
            ? gap(j > 1 && ticks[j - 1] != ticks[j - 2] ? gap_class(ticks[j - 1] - ticks[j - 2]) : 1,
                  ticks[j] - ticks[j - 1])
            : 0;
    int active = 0;
    for (int k = 0; k < statistics_.components; ++k) {
        const Prediction predicted = statistics_.predict(k, c, past, values[j]);
        const std::int32_t rest = values[j][static_cast<std::size_t>(k)] - predicted.nearest;
        bits += difference(k, c, std::min(active, 2), predicted.side, rest);
        active += rest != 0;
    }
    return bits;
}

}  // namespace viaface
