#include "viapoints/strand_fit.hpp"

#include <algorithm>
#include <cmath>

namespace viaface {
namespace {

constexpr double kLeastEmphasis = 1e-3;
constexpr double kSingular = 1e-12;
constexpr double kHopeless_mm2 = 9;  // limits beyond which a strand of a basis is given up

std::size_t at(int i) { return static_cast<std::size_t>(i); }

struct FreePart {
    int begin, end;  // of a row's weights
    int first;       // the free control point of weight 0; may be negative
};

FreePart free_part(const QuinticRow& row, const FitStretch& stretch) {
    const int first = row.first - stretch.free_begin;
    return {std::max(0, -first), std::min(kSupport, stretch.free_end - row.first), first};
}

// Of the strand's components that are missed by `left`.
double squared_distance(const PointMeasure& measure, std::size_t sample, const Quad* left, int quads) {
    if (measure.modes.size() == 0) {
        const Quad square = left->square();
        return square[0] + square[1] + square[2];
    }
    const Eigen::Map<const Eigen::RowVectorXd> components(left->data(), 4 * quads);
    const Eigen::RowVectorXd points =
        measure.residual.row(static_cast<Eigen::Index>(sample)) + components * measure.modes;
    double largest = 0;
    for (Eigen::Index i = 0; i < points.size(); i += 3)
        largest = std::max(largest, points.segment<3>(i).squaredNorm());
    return largest;
}

}  // namespace

// Cholesky without roots of a band of six, and the substitutions.
template <int kQuads>
void StrandFit::solve(const FitStretch& stretch, int quads) {
    if (kQuads > 0) quads = kQuads;
    const int n = stretch.free_end - stretch.free_begin;
    band_.assign(at(n * kSupport), 0.0);
    control.assign(at(n * quads), Quad::Zero());
    for (std::size_t i = 0; i < stretch.rows.size(); ++i) {
        const QuinticRow& row = stretch.rows[i];
        const FreePart part = free_part(row, stretch);
        for (int r = part.begin; r < part.end; ++r) {
            const double weight = emphasis[i] * row.weight[at(r)];
            double* band = &band_[at((part.first + r) * kSupport)];
            for (int s = r; s < part.end; ++s) band[s - r] += weight * row.weight[at(s)];
            for (int k = 0; k < quads; ++k)
                control[at((part.first + r) * quads + k)] += weight * target_[i * at(quads) + at(k)];
        }
    }
    for (int i = 0; i < n; ++i) {
        double* row = &band_[at(i * kSupport)];
        row[0] = 1 / std::max(row[0], kSingular);
        for (int j = 1; j < std::min(kSupport, n - i); ++j) {
            const double factor = row[j] * row[0];
            double* below = &band_[at((i + j) * kSupport)];
            for (int s = j; s < std::min(kSupport, n - i); ++s) below[s - j] -= factor * row[s];
            for (int k = 0; k < quads; ++k)
                control[at((i + j) * quads + k)] -= factor * control[at(i * quads + k)];
        }
    }
    for (int i = n - 1; i >= 0; --i) {
        const double* row = &band_[at(i * kSupport)];
        for (int k = 0; k < quads; ++k) {
            Quad value = control[at(i * quads + k)];
            for (int j = 1; j < std::min(kSupport, n - i); ++j)
                value -= row[j] * control[at((i + j) * quads + k)];
            control[at(i * quads + k)] = value * row[0];
        }
    }
}

template <int kQuads>
void StrandFit::measure_misses(const PointMeasure& measure, const FitStretch& stretch, int quads) {
    if (kQuads > 0) quads = kQuads;
    for (std::size_t i = 0; i < stretch.rows.size(); ++i) {
        const QuinticRow& row = stretch.rows[i];
        const FreePart part = free_part(row, stretch);
        Quad* left = &left_[i * at(quads)];
        for (int k = 0; k < quads; ++k) {
            Quad value = target_[i * at(quads) + at(k)];
            for (int r = part.begin; r < part.end; ++r)
                value -= row.weight[at(r)] * control[at((part.first + r) * quads + k)];
            left[k] = value;
        }
        miss[i] = squared_distance(measure, stretch.first_sample + i, left, quads);
    }
}

// Weights in proportion to distances, with a mean of one.
void StrandFit::emphasise(double largest) {
    double sum = 0;
    for (std::size_t i = 0; i < emphasis.size(); ++i) {
        emphasis[i] *= std::sqrt(miss[i] / largest) + kLeastEmphasis;
        sum += emphasis[i];
    }
    const double scale = static_cast<double>(emphasis.size()) / sum;
    for (double& weight : emphasis) weight *= scale;
}

template <int kQuads>
bool StrandFit::within(const Strand& strand, const PointMeasure& measure, const FitStretch& stretch,
                       const std::vector<Quad>& fixed, double limit_mm2, int rounds) {
    const int quads = kQuads > 0 ? kQuads : strand.quads;
    const std::size_t count = stretch.rows.size();
    target_.resize(count * at(quads));
    left_.resize(target_.size());
    miss.resize(count);
    emphasis.assign(strand.emphasis.begin() + static_cast<std::ptrdiff_t>(stretch.first_sample),
                    strand.emphasis.begin() + static_cast<std::ptrdiff_t>(stretch.first_sample + count));
    for (std::size_t i = 0; i < count; ++i) {
        const QuinticRow& row = stretch.rows[i];
        const FreePart part = free_part(row, stretch);
        for (int k = 0; k < quads; ++k) {
            Quad value = strand.value[(stretch.first_sample + i) * at(quads) + at(k)];
            for (int r = 0; r < std::min(kSupport, stretch.controls - row.first); ++r) {
                if (r >= part.begin && r < part.end) continue;
                value -= row.weight[at(r)] * fixed[at((row.first + r) * quads + k)];
            }
            target_[i * at(quads) + at(k)] = value;
        }
    }
    for (int round = 0; round < rounds; ++round) {
        solve<kQuads>(stretch, quads);
        measure_misses<kQuads>(measure, stretch, quads);
        double largest = 0, weighted = 0, sum = 0;
        for (std::size_t i = 0; i < count; ++i) {
            largest = std::max(largest, miss[i]);
            weighted += emphasis[i] * miss[i];
            sum += emphasis[i];
        }
        if (largest <= limit_mm2) return true;
        const bool hopeless =
            measure.modes.size() == 0 ? weighted > limit_mm2 * sum : largest > kHopeless_mm2 * limit_mm2;
        if (hopeless) return false;
        emphasise(largest);
    }
    return false;
}

bool StrandFit::within(const Strand& strand, const PointMeasure& measure, const FitStretch& stretch,
                       const std::vector<Quad>& fixed, double limit_mm2, int rounds) {
    if (strand.quads == 1) return within<1>(strand, measure, stretch, fixed, limit_mm2, rounds);
    return within<0>(strand, measure, stretch, fixed, limit_mm2, rounds);
}

}  // namespace viaface
