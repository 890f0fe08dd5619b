#include "viapoints/motion_at.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace viaface {
namespace {

using Eigen::Index;

// Slope at sample i, per s, of the coordinates; of the chord from `from` to `to` where a neighbour is
// missing.
Configuration slope(const Motion& motion, std::size_t i, const Configuration& chord) {
    if (i == 0 || i + 1 == motion.size()) return chord;
    const std::vector<double>& t = motion.time_s;
    const double before = t[i] - t[i - 1], after = t[i + 1] - t[i];
    const Configuration back = (motion.at(i) - motion.at(i - 1)) / before,
                        ahead = (motion.at(i + 1) - motion.at(i)) / after;
    const Configuration parabola = (after * back + before * ahead) / (before + after);
    return parabola.array().isNaN().select(chord, parabola);
}

}  // namespace

BetweenSamples between_samples(const std::vector<double>& time_s, double at_s) {
    if (time_s.empty() || !std::isfinite(at_s)) throw std::invalid_argument("no sample, or no time");
    const auto after = std::upper_bound(time_s.begin(), time_s.end(), at_s);
    if (after == time_s.begin()) return {0, 0};
    const auto sample = static_cast<std::size_t>(after - time_s.begin()) - 1;
    if (after == time_s.end()) return {sample, 0};
    return {sample, (at_s - time_s[sample]) / (*after - time_s[sample])};
}

Configuration motion_at(const Motion& motion, double time_s) {
    const auto [i, s] = between_samples(motion.time_s, time_s);
    const Configuration here = motion.at(i);
    if (s == 0) return here;
    const Configuration next = motion.at(i + 1);
    const double step = motion.time_s[i + 1] - motion.time_s[i];
    const Configuration chord = (next - here) / step;
    const double r = 1 - s;
    return here * (r * r * (1 + 2 * s)) + next * (s * s * (1 + 2 * r)) +
           step * (slope(motion, i, chord) * (s * r * r) - slope(motion, i + 1, chord) * (s * s * r));
}

double extra_at(const std::vector<double>& time_s, const std::vector<double>& values, double at_s) {
    const auto [i, s] = between_samples(time_s, at_s);
    return s == 0 ? values[i] : (1 - s) * values[i] + s * values[i + 1];
}

}  // namespace viaface
