// What rows of via points cost in bits by a stream's statistics as they stand, without what is learned on the
// way. Predictions are kept as sums, so that a change of one value is followed by additions alone.
#pragma once

#include "viapoints/stream_statistics.hpp"

namespace viaface {

using PredictionSums = std::vector<std::int64_t>;  // one per component, in 1/4096 of a step

class StreamCost {
  public:
    explicit StreamCost(const StreamStatistics& statistics);

    int components() const { return statistics_.components; }
    double gap(int context, int ticks) const;
    // Of a row's values; `row` is its class.
    double values(int row, const PredictionSums& sums, const ViaValues& values) const;

    void predict(int row, const ViaPast& past, const ViaValues& now, PredictionSums& sums) const;
    // How sums change with component k of the row itself, of the one before, and of the one before that.
    void add_now(int row, int k, std::int64_t by, PredictionSums& sums) const;
    void add_last(int row, int k, std::int64_t by, PredictionSums& sums) const;
    void add_before(int row, int k, std::int64_t by, PredictionSums& sums) const;

  private:
    static constexpr int kLookedUp = kUnaryLimit + 1;  // of differences, either way
    const std::int64_t* of(const std::vector<std::int64_t>& weights, int row, int k) const {
        return weights.data() + (row * components() + k) * components();
    }

    const StreamStatistics& statistics_;
    std::vector<std::int64_t> now_, last_;  // [kRowClasses][k, told][components, predicted]
    std::vector<std::int64_t> before_;      // [kRowClasses][components]
    std::vector<float> difference_;         // [kRowClasses][components][3 active][kLeans][2 kLookedUp + 1]
    std::vector<double> gap_;               // [kGapContexts][kMostGapTicks + 1]
};

}  // namespace viaface
