// When the eyes blink: a seeded schedule, the same for the same seed.
// Intervals are drawn from 2 to 6 s; a blink shuts in 0.08 s, stays 0.04 s and opens in 0.16 s.
#pragma once

#include <cstdint>
#include <vector>

namespace viaface {

class BlinkSchedule {
  public:
    BlinkSchedule(double duration_s, std::uint64_t seed);

    double amount(double time_s) const;  // 0 open, 1 shut
    const std::vector<double>& starts() const { return starts_; }

    static constexpr double kShutting = 0.08, kShut = 0.04, kOpening = 0.16;  // s

  private:
    std::vector<double> starts_;  // s, rising, at least one blink's length apart
};

}  // namespace viaface
