// Repeatable random numbers, and smooth motions made of them, for tests.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

#include "viapoints/motion.hpp"

namespace viaface {

// splitmix64 [Steele et al. 2014]
class Dice {
  public:
    explicit Dice(std::uint64_t seed) : state_(seed) {}

    double uniform() {  // [0, 1)
        std::uint64_t z = (state_ += 0x9e3779b97f4a7c15ull);
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
        return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
    }
    double normal() {
        const double radius = std::sqrt(-2 * std::log(1 - uniform()));
        return radius * std::cos(2 * std::numbers::pi * uniform());
    }

  private:
    std::uint64_t state_;
};

// `sources` sums of sinusoids up to 6 Hz, mixed into the first `points` points; the rest is NaN. About 10 mm
// of reach.
inline Motion smooth_motion(std::uint64_t seed, double seconds, double rate_hz, int points, int sources = 6) {
    Dice dice(seed);
    constexpr int kWaves = 8;
    const auto draw = [&](Eigen::Index rows, Eigen::Index cols) {
        return RowMatrix(RowMatrix::NullaryExpr(rows, cols, [&] { return dice.normal(); }));
    };
    const RowMatrix mixing = draw(3 * points, sources), rest = 20 * draw(3 * points, 1);
    const RowMatrix amplitude = draw(sources, kWaves), phase = 10 * draw(sources, kWaves);
    Motion motion;
    const auto samples = static_cast<Eigen::Index>(seconds * rate_hz) + 1;
    motion.positions = RowMatrix::Constant(samples, kCoordinates, std::numeric_limits<double>::quiet_NaN());
    for (Eigen::Index i = 0; i < samples; ++i) {
        const double t = static_cast<double>(i) / rate_hz;
        motion.time_s.push_back(t);
        Eigen::VectorXd source = Eigen::VectorXd::Zero(sources);
        for (Eigen::Index k = 0; k < sources; ++k) {
            for (Eigen::Index w = 0; w < kWaves; ++w) {
                const double hz =
                    6.0 * (static_cast<double>(w) + 0.3 + 0.1 * static_cast<double>(k)) / kWaves;
                source[k] += amplitude(k, w) / std::sqrt(kWaves) *
                             std::sin(2 * std::numbers::pi * hz * t + phase(k, w));
            }
        }
        motion.positions.row(i).head(3 * points) = (rest + mixing * source).transpose();
    }
    return motion;
}

}  // namespace viaface
