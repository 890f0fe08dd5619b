#include "synth/pose/blinks.hpp"

#include <algorithm>

#include "facemodel/remesh.hpp"

namespace viaface {
namespace {

constexpr double kShortest = 2.0, kLongest = 6.0, kFirst = 0.9;  // s

double smooth(double t) { return t * t * (3 - 2 * t); }

}  // namespace

BlinkSchedule::BlinkSchedule(double duration_s, std::uint64_t seed) {
    Dice dice(seed);
    for (double t = kFirst + dice.unit(); t < duration_s;
         t += kShortest + (kLongest - kShortest) * dice.unit()) {
        starts_.push_back(t);
    }
}

double BlinkSchedule::amount(double time_s) const {
    const auto after = std::upper_bound(starts_.begin(), starts_.end(), time_s);
    if (after == starts_.begin()) return 0;
    const double since = time_s - *(after - 1);
    if (since < kShutting) return smooth(since / kShutting);
    if (since < kShutting + kShut) return 1;
    const double opening = (since - kShutting - kShut) / kOpening;
    return opening < 1 ? 1 - smooth(opening) : 0;
}

}  // namespace viaface
