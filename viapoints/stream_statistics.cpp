#include "viapoints/stream_statistics.hpp"

#include <algorithm>
#include <numeric>

namespace viaface {
namespace {

constexpr std::uint16_t kRarely =
    655;  // of 65536, that a component which the table lacks is not as predicted
constexpr std::uint8_t kRarelySeen = 20;

}  // namespace

int gap_class(int gap_ticks) { return gap_ticks <= 4 ? 0 : gap_ticks <= 8 ? 1 : 2; }

int gap_context(int before, bool still) { return std::min(before, 4) - 1 + (still ? 4 : 0); }

std::size_t StreamStatistics::weights_at(int j, int row) const {
    const auto k = static_cast<std::size_t>(components), n = static_cast<std::size_t>(j);
    const std::size_t before = kRowClasses * (n * (2 + k) + n * (n - 1) / 2);
    return before + static_cast<std::size_t>(row) * features(components, j);
}

std::int64_t StreamStatistics::prediction_sum(int j, int row, const ViaPast& past,
                                              const ViaValues& now) const {
    const std::int32_t* w = weights.data() + weights_at(j, row);
    std::int64_t sum = *w++;
    for (int i = 0; i < components; ++i) sum += std::int64_t{*w++} * past.last[static_cast<std::size_t>(i)];
    sum += std::int64_t{*w++} * past.before[static_cast<std::size_t>(j)];
    for (int i = 0; i < j; ++i) sum += std::int64_t{*w++} * now[static_cast<std::size_t>(i)];
    return sum;
}

Prediction StreamStatistics::predict(int j, int row, const ViaPast& past, const ViaValues& now) const {
    return rounded_prediction(prediction_sum(j, row, past, now));
}

StreamStatistics plain_statistics(int components) {
    StreamStatistics plain;
    plain.components = components;
    plain.value.resize(static_cast<std::size_t>(components));
    std::size_t size = 0;
    for (int j = 0; j < components; ++j) size += kRowClasses * StreamStatistics::features(components, j);
    plain.weights.assign(size, 0);
    for (int j = 0; j < components; ++j) {
        for (int c = 0; c < kRowClasses; ++c)
            plain.weights[plain.weights_at(j, c) + 1 + static_cast<std::size_t>(j)] = kWeightOne;
    }
    return plain;
}

StreamStatistics with_components(const StreamStatistics& statistics, const std::vector<int>& chosen,
                                 int components) {
    StreamStatistics other = plain_statistics(components);
    if (statistics.components == 0) return other;
    other.bound_mm = statistics.bound_mm;
    other.step_mm = statistics.step_mm;
    other.gap = statistics.gap;
    other.beyond = statistics.beyond;
    std::vector<int> known;
    for (const int mode : chosen)
        if (mode < statistics.components) known.push_back(mode);
    const int common = static_cast<int>(known.size());
    for (int j = 0; j < components; ++j) {
        ValueContexts& value = other.value[static_cast<std::size_t>(j)];
        if (j >= common) {
            for (auto& row : value.any)
                for (auto& active : row) active.fill({kRarely, kRarelySeen});
            continue;
        }
        const int mode = known[static_cast<std::size_t>(j)];
        value = statistics.value[static_cast<std::size_t>(mode)];
        for (int row = 0; row < kRowClasses; ++row) {
            const std::int32_t* from = statistics.weights.data() + statistics.weights_at(mode, row);
            std::int32_t* to = other.weights.data() + other.weights_at(j, row);
            std::fill(to, to + 1 + components, 0);
            to[0] = from[0];
            const std::int32_t* now = from + 2 + statistics.components;
            for (int i = 0; i < common; ++i) to[1 + i] = from[1 + known[static_cast<std::size_t>(i)]];
            to[1 + components] = from[1 + statistics.components];
            for (int i = 0; i < j; ++i) to[2 + components + i] = now[known[static_cast<std::size_t>(i)]];
        }
    }
    return other;
}

StreamStatistics with_components(const StreamStatistics& statistics, int components) {
    std::vector<int> chosen(static_cast<std::size_t>(std::min(components, statistics.components)));
    std::iota(chosen.begin(), chosen.end(), 0);
    return with_components(statistics, chosen, components);
}

void put_features(int j, const ViaPast& past, const ViaValues& now, std::vector<double>& features) {
    features.assign(1, 1.0);
    features.insert(features.end(), past.last.begin(), past.last.end());
    features.push_back(past.before[static_cast<std::size_t>(j)]);
    features.insert(features.end(), now.begin(), now.begin() + j);
}

}  // namespace viaface
