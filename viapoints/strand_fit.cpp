#include "viapoints/strand_fit.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <type_traits>

namespace viaface {
namespace {

using Eigen::Index;

constexpr double kLeastEmphasis = 1e-3;
constexpr double kSingular = 1e-12;
constexpr double kHopeless_mm2 = 9;  // limits beyond which a strand of a basis is given up

std::size_t at(int i) { return static_cast<std::size_t>(i); }

// Numbers that are worked on side by side: of a sample, or of a control point.
using Pair = double __attribute__((vector_size(2 * sizeof(double))));

template <class Number>
Number load(const double* from) {
    Number number;
    std::memcpy(&number, from, sizeof number);
    return number;
}

template <class Number>
void store(double* to, const Number& number) {
    std::memcpy(to, &number, sizeof number);
}

// A coordinate alone, or four numbers.
template <int kWidth>
struct Lane {
    using Number = std::conditional_t<kWidth == 1, double, Pair>;
    static constexpr int kNumbers = kWidth == 1 ? 1 : 2;
    Number number[kNumbers];

    static Lane zero() { return {}; }
    static Lane at(const double* from) {
        Lane lane;
        for (int i = 0; i < kNumbers; ++i) lane.number[i] = load<Number>(from + i * kWidth / kNumbers);
        return lane;
    }
    void put(double* to) const {
        for (int i = 0; i < kNumbers; ++i) store(to + i * kWidth / kNumbers, number[i]);
    }
    void add(double weight, const Lane& other) {
        for (int i = 0; i < kNumbers; ++i) number[i] += weight * other.number[i];
    }
    void subtract(double weight, const Lane& other) {
        for (int i = 0; i < kNumbers; ++i) number[i] -= weight * other.number[i];
    }
};

// Calls with each run of rows that name the same control points: the first row and the one after the last.
void for_each_run(const std::vector<QuinticRow>& rows, const auto& visit) {
    for (std::size_t begin = 0, end = 0; begin < rows.size(); begin = end) {
        while (end < rows.size() && rows[end].first == rows[begin].first) ++end;
        visit(begin, end);
    }
}

double longest_squared(const double* points, Index coordinates) {
    double longest = 0;
    for (Index i = 0; i < coordinates; i += 3)
        longest = std::max(
            longest, points[i] * points[i] + points[i + 1] * points[i + 1] + points[i + 2] * points[i + 2]);
    return longest;
}

// Adds the right sides of the normal equations, samples weighing `emphasis` or 1; kWidth of `width` numbers.
template <int kWidth>
void gather_right(const FitStretch& stretch, const double* emphasis, const double* value, int width,
                  double* right) {
    for_each_run(stretch.rows, [&](std::size_t begin, std::size_t end) {
        Lane<kWidth> sum[kSupport] = {};
        for (std::size_t i = begin; i < end; ++i) {
            const auto sample = Lane<kWidth>::at(value + i * at(width));
            const double weight = emphasis ? emphasis[i] : 1;
            for (int r = 0; r < kSupport; ++r) sum[r].add(weight * stretch.rows[i].weight[at(r)], sample);
        }
        for (int r = 0; r < kSupport; ++r) {
            double* to = right + (stretch.rows[begin].first + r) * width;
            auto all = Lane<kWidth>::at(to);
            all.add(1, sum[r]);
            all.put(to);
        }
    });
}

// Samples less the spline.
template <int kWidth>
void find_left(const FitStretch& stretch, const double* value, int width, const double* held, double* left) {
    for_each_run(stretch.rows, [&](std::size_t begin, std::size_t end) {
        Lane<kWidth> control[kSupport];
        for (int r = 0; r < kSupport; ++r)
            control[r] = Lane<kWidth>::at(held + (stretch.rows[begin].first + r) * width);
        for (std::size_t i = begin; i < end; ++i) {
            auto rest = Lane<kWidth>::at(value + i * at(width));
            for (int r = 0; r < kSupport; ++r) rest.subtract(stretch.rows[i].weight[at(r)], control[r]);
            rest.put(left + i * at(width));
        }
    });
}

}  // namespace

bool Strand::even(std::size_t first, std::size_t count) const {
    return std::all_of(emphasis.begin() + static_cast<std::ptrdiff_t>(first),
                       emphasis.begin() + static_cast<std::ptrdiff_t>(first + count),
                       [](double weight) { return weight == 1; });
}

void FitStretch::find_products() {
    products.resize(rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        std::size_t p = 0;
        for (std::size_t r = 0; r < kSupport; ++r)
            for (std::size_t s = r; s < kSupport; ++s)
                products[i][p++] = rows[i].weight[r] * rows[i].weight[s];
        products[i][p] = 0;
    }
}

void NormalMatrix::factor(const FitStretch& stretch, std::span<const double> emphasis) {
    band_.assign(at((stretch.controls + kSupport - 1) * kSupport), 0.0);
    for_each_run(stretch.rows, [&](std::size_t begin, std::size_t end) {
        Pair sum[kProducts / 2] = {};
        for (std::size_t i = begin; i < end; ++i) {
            const double weight = emphasis.empty() ? 1 : emphasis[i];
            for (int p = 0; p < kProducts / 2; ++p)
                sum[p] += weight * load<Pair>(&stretch.products[i][at(2 * p)]);
        }
        double* band = &band_[at(stretch.rows[begin].first * kSupport)];
        for (int r = 0, p = 0; r < kSupport; ++r)
            for (int s = r; s < kSupport; ++s, ++p) band[r * kSupport + s - r] += sum[p / 2][p % 2];
    });
    const int n = stretch.free_end - stretch.free_begin;
    factor_.assign(&band_[at(stretch.free_begin * kSupport)], &band_[at(stretch.free_end * kSupport)]);
    for (int i = 0; i < n; ++i) {
        double* row = &factor_[at(i * kSupport)];
        row[0] = 1 / std::max(row[0], kSingular);
        for (int j = 1; j < std::min(kSupport, n - i); ++j) {
            const double ratio = row[j] * row[0];
            double* below = &factor_[at((i + j) * kSupport)];
            for (int s = j; s < std::min(kSupport, n - i); ++s) below[s - j] -= ratio * row[s];
        }
    }
}

template <int kWidth>
void NormalMatrix::move_held(const FitStretch& stretch, int width, const double* control,
                             double* right) const {
    const int begin = stretch.free_begin, end = stretch.free_end;
    const auto subtract = [&](int from, double factor, int what) {
        auto value = Lane<kWidth>::at(right + from * width);
        value.subtract(factor, Lane<kWidth>::at(control + what * width));
        value.put(right + from * width);
    };
    for (int i = std::max(0, begin - kSupport + 1); i < begin; ++i)
        for (int j = begin - i; j < kSupport; ++j) subtract(i + j, band_[at(i * kSupport + j)], i);
    for (int i = std::max(begin, end - kSupport + 1); i < end; ++i)
        for (int j = end - i; j < std::min(kSupport, stretch.controls - i); ++j)
            subtract(i, band_[at(i * kSupport + j)], i + j);
}

template <int kWidth>
void NormalMatrix::solve(const FitStretch& stretch, int width, double* right, double* control) const {
    const int begin = stretch.free_begin, n = stretch.free_end - begin;
    for (int i = 0; i < n; ++i) {
        const double* row = &factor_[at(i * kSupport)];
        double* own = right + (begin + i) * width;
        const auto value = Lane<kWidth>::at(own);
        for (int j = 1; j < std::min(kSupport, n - i); ++j) {
            auto other = Lane<kWidth>::at(own + j * width);
            other.subtract(row[j] * row[0], value);
            other.put(own + j * width);
        }
    }
    for (int i = n - 1; i >= 0; --i) {
        const double* row = &factor_[at(i * kSupport)];
        double* found = control + (begin + i) * width;
        auto value = Lane<kWidth>::at(right + (begin + i) * width), scaled = Lane<kWidth>::zero();
        // the one just found comes last: the others need not wait for it
        for (int j = std::min(kSupport, n - i) - 1; j > 0; --j)
            value.subtract(row[j], Lane<kWidth>::at(found + j * width));
        scaled.add(row[0], value);
        scaled.put(found);
    }
}

void StrandFit::measure_misses(const PointMeasure& measure, const FitStretch& stretch, int width,
                               FitBench& bench) {
    const std::vector<double>& left = bench.left;
    RowMatrix& points = bench.points;
    const auto rows = static_cast<Index>(stretch.rows.size());
    if (width == 1) {
        for (std::size_t i = 0; i < miss.size(); ++i) miss[i] = left[i] * left[i];
    } else if (measure.modes.size() == 0) {
        for (std::size_t i = 0; i < miss.size(); ++i) miss[i] = longest_squared(&left[4 * i], 3);
    } else {
        points.noalias() = Eigen::Map<const RowMatrix>(left.data(), rows, width) * measure.modes;
        points += measure.residual.middleRows(static_cast<Index>(stretch.first_sample), rows);
        for (Index i = 0; i < rows; ++i)
            miss[static_cast<std::size_t>(i)] = longest_squared(points.row(i).data(), points.cols());
    }
}

template <int kWidth>
void StrandFit::solve(const Strand& strand, const FitStretch& stretch, const NormalMatrix& matrix, bool even,
                      FitBench& bench) {
    const int width = strand.width;
    const double* value = &strand.value[stretch.first_sample * at(width)];
    bench.right.assign(at((stretch.controls + kSupport - 1) * width), 0.0);
    bench.left.resize(stretch.rows.size() * at(width));
    for (int k = 0; k < width; k += kWidth)
        gather_right<kWidth>(stretch, even ? nullptr : emphasis.data(), value + k, width,
                             bench.right.data() + k);
    for (int k = 0; k < width; k += kWidth) {
        matrix.move_held<kWidth>(stretch, width, control.data() + k, bench.right.data() + k);
        matrix.solve<kWidth>(stretch, width, bench.right.data() + k, control.data() + k);
        find_left<kWidth>(stretch, value + k, width, control.data() + k, bench.left.data() + k);
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

bool StrandFit::within(const Strand& strand, const PointMeasure& measure, const FitStretch& stretch,
                       const NormalMatrix* even, double limit_mm2, int rounds, FitBench& bench) {
    const std::size_t count = stretch.rows.size();
    miss.resize(count);
    emphasis.assign(strand.emphasis.begin() + static_cast<std::ptrdiff_t>(stretch.first_sample),
                    strand.emphasis.begin() + static_cast<std::ptrdiff_t>(stretch.first_sample + count));
    const bool in_basis = measure.modes.size() > 0;
    double before = 0;
    for (int round = 0; round < rounds; ++round) {
        const bool shared = round == 0 && even;
        if (!shared) bench.matrix.factor(stretch, emphasis);
        const NormalMatrix& matrix = shared ? *even : bench.matrix;
        if (strand.width == 1)
            solve<1>(strand, stretch, matrix, shared, bench);
        else
            solve<4>(strand, stretch, matrix, shared, bench);
        measure_misses(measure, stretch, strand.width, bench);
        double largest = 0, weighted = 0, sum = 0;
        for (std::size_t i = 0; i < count; ++i) {
            largest = std::max(largest, miss[i]);
            weighted += emphasis[i] * miss[i];
            sum += emphasis[i];
        }
        if (largest <= limit_mm2) return true;
        if (in_basis ? largest > kHopeless_mm2 * limit_mm2 : weighted > limit_mm2 * sum) return false;
        const double left = rounds - 1 - round;  // falling on as it fell, it would not come there
        if (round >= 2 && largest * std::pow(largest / before, left) > limit_mm2) return false;
        before = largest;
        emphasise(largest);
    }
    return false;
}

}  // namespace viaface
