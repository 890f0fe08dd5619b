#include "viapoints/strand_fit.hpp"

#include <algorithm>

namespace viaface {
namespace {

using Eigen::Index;

constexpr double kHopeless_mm2 = 9;  // limits beyond which a strand of a basis is given up

std::size_t at(int i) { return static_cast<std::size_t>(i); }

double longest_squared(const double* points, Index coordinates) {
    double longest = 0;
    for (Index i = 0; i < coordinates; i += 3)
        longest = std::max(
            longest, points[i] * points[i] + points[i + 1] * points[i + 1] + points[i + 2] * points[i + 2]);
    return longest;
}

// Of strands that are not within the limit; 0 of the others.
Lanes largest_beyond(const Misses& misses, double limit_mm2) {
    Lanes beyond{};
    for (int i = 0; i < kLanes; ++i)
        if (misses.largest.lane[i] > limit_mm2) beyond.lane[i] = misses.largest.lane[i];
    return beyond;
}

bool none(const Lanes& lanes) {
    return std::ranges::all_of(lanes.lane, [](double one) { return one == 0; });
}

bool unreachable(const Misses& misses, double limit_mm2) {
    for (int i = 0; i < kLanes; ++i)
        if (misses.weighted.lane[i] > limit_mm2 * misses.emphasis.lane[i]) return true;
    return false;
}

double power(double base, int exponent) {
    double product = 1;
    while (exponent-- > 0) product *= base;
    return product;
}

// Whether some strand, falling on as it fell, would not come within the limit in the rounds that are left.
bool too_slow(const Lanes& before, const Lanes& now, int left, double limit_mm2) {
    for (int i = 0; i < kLanes; ++i)
        if (now.lane[i] > 0 && now.lane[i] * power(now.lane[i] / before.lane[i], left) > limit_mm2)
            return true;
    return false;
}

}  // namespace

void NormalMatrix::factor(const StrandKernel& kernel, const FitStretch& stretch, const Lanes* emphasis) {
    band.resize(at((stretch.controls + kSupport - 1) * kSupport));
    factors.resize(at((stretch.free_end - stretch.free_begin) * kSupport));
    kernel.factor(stretch.view(), emphasis, band.data(), factors.data());
}

void BraidFit::measure_misses(const Braid& braid, const PointMeasure& measure, const FitStretch& stretch,
                              FitBench& bench) {
    const Lanes* value = &braid.value[stretch.first_sample * at(braid.vectors)];
    if (measure.modes.size() == 0)
        return bench.kernel->miss(stretch.view(), braid.vectors, value, control.data(), miss.data());
    const auto rows = std::ssize(stretch.rows);
    bench.left.resize(stretch.rows.size() * at(braid.vectors));
    bench.kernel->leave(stretch.view(), braid.vectors, value, control.data(), bench.left.data());
    bench.points.noalias() =
        Eigen::Map<const RowMatrix>(bench.left[0].lane, rows, kLanes * braid.vectors) * measure.modes;
    bench.points += measure.residual.middleRows(static_cast<Index>(stretch.first_sample), rows);
    for (Index i = 0; i < rows; ++i)
        std::ranges::fill(miss[static_cast<std::size_t>(i)].lane,
                          longest_squared(bench.points.row(i).data(), bench.points.cols()));
}

void BraidFit::emphasise(const Braid& braid, const FitStretch& stretch, const Lanes& largest,
                         const FitBench& bench) {
    if (emphasis.empty())
        emphasis.assign(&braid.emphasis[stretch.first_sample],
                        &braid.emphasis[stretch.first_sample] + stretch.rows.size());
    bench.kernel->emphasise(std::ssize(emphasis), miss.data(), &largest, emphasis.data());
}

bool BraidFit::within(const Braid& braid, const PointMeasure& measure, const FitStretch& stretch,
                      const NormalMatrix* even, double limit_mm2, int rounds, FitBench& bench) {
    const StrandKernel& kernel = *bench.kernel;
    emphasis.clear();
    miss.resize(stretch.rows.size());
    bench.right.resize(at((stretch.controls + kSupport - 1) * braid.vectors));
    Lanes before{};
    for (int round = 0; round < rounds; ++round) {
        const Lanes* weights = emphasis.empty() ? &braid.emphasis[stretch.first_sample] : emphasis.data();
        const bool shared = round == 0 && even;
        if (!shared) bench.matrix.factor(kernel, stretch, weights);
        const NormalMatrix& matrix = shared ? *even : bench.matrix;
        kernel.solve(stretch.view(), matrix.band.data(), matrix.factors.data(), weights, braid.vectors,
                     &braid.value[stretch.first_sample * at(braid.vectors)], bench.right.data(),
                     control.data());
        measure_misses(braid, measure, stretch, bench);
        const Misses misses = kernel.judge(std::ssize(miss), weights, miss.data());
        const Lanes beyond = largest_beyond(misses, limit_mm2);
        if (none(beyond)) return true;
        if (measure.modes.size() > 0 ? beyond.lane[0] > kHopeless_mm2 * limit_mm2
                                     : unreachable(misses, limit_mm2))
            return false;
        if (round >= 2 && too_slow(before, beyond, rounds - 1 - round, limit_mm2)) return false;
        before = beyond;
        emphasise(braid, stretch, beyond, bench);
    }
    return false;
}

}  // namespace viaface
