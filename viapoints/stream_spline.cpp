#include "viapoints/stream_spline.hpp"

#include <algorithm>
#include <array>

namespace viaface {
namespace {

using Eigen::Index;

constexpr int kDegree = 5;

// The six B-splines that are not zero in interval `interval`, at x [deBoor78, algorithm BSPLVB].
std::array<double, kDegree + 1> basis_at(const std::vector<int>& knots, std::ptrdiff_t interval, double x) {
    const auto last = static_cast<std::ptrdiff_t>(knots.size()) - 1;
    const auto knot = [&](std::ptrdiff_t i) {
        return double(knots[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(i, 0, last))]);
    };
    std::array<double, kDegree + 1> value{1};
    std::array<double, kDegree + 1> left{}, right{};
    for (std::size_t j = 1; j <= kDegree; ++j) {
        left[j] = x - knot(interval + 1 - static_cast<std::ptrdiff_t>(j));
        right[j] = knot(interval + static_cast<std::ptrdiff_t>(j)) - x;
        double saved = 0;
        for (std::size_t r = 0; r < j; ++r) {
            const double part = value[r] / (right[r + 1] + left[j - r]);
            value[r] = saved + right[r + 1] * part;
            saved = left[j - r] * part;
        }
        value[j] = saved;
    }
    return value;
}

}  // namespace

bool moves_first(const std::vector<int>& ticks) { return ticks[1] == ticks[0]; }

bool moves_last(const std::vector<int>& ticks) { return ticks[ticks.size() - 2] == ticks.back(); }

RowMatrix control_weights(const std::vector<int>& via_ticks, const std::vector<double>& at_ticks) {
    const auto controls = static_cast<Index>(via_ticks.size());
    const std::vector<int> knots(via_ticks.begin() + (moves_first(via_ticks) ? 2 : 0),
                                 via_ticks.end() - (moves_last(via_ticks) ? 2 : 0));
    const Index first = moves_first(via_ticks) ? 0 : 2, intervals = static_cast<Index>(knots.size()) - 1;
    RowMatrix weights = RowMatrix::Zero(static_cast<Index>(at_ticks.size()), controls);
    Index interval = 0;
    for (std::size_t n = 0; n < at_ticks.size(); ++n) {
        while (interval > 0 && at_ticks[n] < knots[static_cast<std::size_t>(interval)]) --interval;
        while (interval + 1 < intervals && at_ticks[n] >= knots[static_cast<std::size_t>(interval) + 1])
            ++interval;
        const auto six = basis_at(knots, interval, at_ticks[n]);
        for (Index i = 0; i <= kDegree; ++i) {
            const Index control = std::clamp<Index>(interval + i - first, 0, controls - 1);
            weights(static_cast<Index>(n), control) += six[static_cast<std::size_t>(i)];
        }
    }
    return weights;
}

}  // namespace viaface
