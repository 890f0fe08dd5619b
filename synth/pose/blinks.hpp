// When the eyes blink: a seeded schedule without an end, the same for the same seed.
// Intervals are drawn from 2 to 6 s; a blink shuts in 0.08 s, stays 0.04 s and opens in 0.16 s.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "facemodel/remesh.hpp"

namespace viaface {

class BlinkSchedule {
  public:
    explicit BlinkSchedule(std::uint64_t seed);

    double amount(double time_s);                    // 0 open, 1 shut
    std::span<const double> starts(double until_s);  // s: of the blinks that begin up to then

    static constexpr double kShutting = 0.08, kShut = 0.04, kOpening = 0.16;  // s

  private:
    Dice dice_;
    std::vector<double> starts_;  // s, rising, at least one blink's length apart: as many as were asked for
};

}  // namespace viaface
