#include "synth/pose/blinks.hpp"

#include <algorithm>

namespace viaface {
namespace {

constexpr double kShortest = 2.0, kLongest = 6.0, kFirst = 0.9;  // s

double smooth(double t) { return t * t * (3 - 2 * t); }

}  // namespace

BlinkSchedule::BlinkSchedule(std::uint64_t seed) : dice_(seed), starts_{kFirst + dice_.unit()} {}

std::span<const double> BlinkSchedule::starts(double until_s) {
    while (starts_.back() <= until_s) {
        starts_.push_back(starts_.back() + kShortest + (kLongest - kShortest) * dice_.unit());
    }
    return {starts_.begin(), std::ranges::upper_bound(starts_, until_s)};
}

double BlinkSchedule::amount(double time_s) {
    const auto begun = starts(time_s);
    if (begun.empty()) return 0;
    const double since = time_s - begun.back();
    if (since < kShutting) return smooth(since / kShutting);
    if (since < kShutting + kShut) return 1;
    const double opening = (since - kShutting - kShut) / kOpening;
    return opening < 1 ? 1 - smooth(opening) : 0;
}

}  // namespace viaface
