// What via points cost in bits by a stream's statistics as they stand, without what is learned on the way.
#pragma once

#include "viapoints/stream_statistics.hpp"

namespace viaface {

class StreamCost {
  public:
    explicit StreamCost(const StreamStatistics& statistics);

    // Via point j with the gap before it.
    double event(const std::vector<int>& ticks, const std::vector<ViaValues>& values, std::size_t j) const;
    double gap(int class_before, int ticks) const;

  private:
    static constexpr int kFurthest = 40;
    double difference(int component, int gap_class, int active, int side, std::int32_t value) const;

    const StreamStatistics& statistics_;
    std::vector<float> difference_;  // [components][kGapClasses][3 active][3 side][2 kFurthest + 1]
    std::vector<double> gap_;        // [3][kMostGapTicks + 1]
};

}  // namespace viaface
