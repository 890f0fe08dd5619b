#include "viapoints/quintic_rows.hpp"

#include <algorithm>
#include <utility>

namespace viaface {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

// Times that rows are found for side by side.
constexpr std::size_t kAtOnce = 4;
typedef double Times __attribute__((vector_size(kAtOnce * sizeof(double))));

}  // namespace

double QuinticBasis::time(int i) const { return time_s_[at(std::clamp(i, 0, last_))]; }

// The r-th derivative at an end is the first of the r-th differences of the coefficients, each divided by its
// span; distance[i] is the span from the end to the i-th via time. Third and fourth are zero.
QuinticBasis::Fold QuinticBasis::fold(const std::array<double, 5>& distance) {
    std::array<std::array<double, 5>, 5> polygon{};
    for (std::size_t i = 0; i < 5; ++i) polygon[i][i] = 1;
    std::array<std::array<double, 5>, 2> row{};
    for (std::size_t order = 1; order <= 4; ++order) {
        for (std::size_t i = 0; i + order < 5; ++i) {
            for (std::size_t j = 0; j < 5; ++j)
                polygon[i][j] = (polygon[i + 1][j] - polygon[i][j]) * (distance[1] / distance[i + 1]);
        }
        if (order >= 3) row[order - 3] = polygon[0];
    }
    const auto &p = row[0], &q = row[1];
    const double determinant = p[0] * q[1] - p[1] * q[0];
    Fold fold{};
    for (std::size_t j = 0; j < 3; ++j) {
        fold[0][j] = -(p[j + 2] * q[1] - p[1] * q[j + 2]) / determinant;
        fold[1][j] = -(p[0] * q[j + 2] - p[j + 2] * q[0]) / determinant;
    }
    return fold;
}

QuinticBasis::QuinticBasis(std::span<const double> time_s, bool first_is_end, bool last_is_end)
    : time_s_(time_s),
      last_(static_cast<int>(time_s.size()) - 1),
      first_is_end_(first_is_end),
      last_is_end_(last_is_end) {
    std::array<double, 5> from_first{}, from_last{};
    for (int i = 1; i < 5; ++i) {
        from_first[at(i)] = time(i) - time(0);
        from_last[at(i)] = time(last_) - time(last_ - i);
    }
    if (first_is_end) first_fold_ = fold(from_first);
    if (last_is_end) last_fold_ = fold(from_last);
}

// weight[k - segment + 4] belongs to the control point of via time k; -2, -1, last + 1 and last + 2 are
// folded.
void QuinticBasis::fold_ends(int segment, Weights& weight) const {
    const auto fold = [&](int from, int to, const std::array<double, 3>& share, int step) {
        const double beyond = std::exchange(weight[at(from - segment + 4)], 0.0);
        for (int m = 0; m < 3; ++m) weight[at(to + step * m - segment + 4)] += beyond * share[at(m)];
    };
    for (int e = 0; e < 2; ++e) {
        if (first_is_end_ && segment < 2) fold(e - 2, 0, first_fold_[at(e)], 1);
        if (last_is_end_ && segment > last_ - 3) fold(last_ + 2 - e, last_, last_fold_[at(e)], -1);
    }
}

void QuinticBasis::fold_row(int segment, QuinticRow& row) const {
    Weights weight{};
    std::copy_n(row.weight, kSupport, weight.begin() + 2);
    fold_ends(segment, weight);
    std::copy_n(weight.begin() + row.first - segment + 4, kSupport, row.weight);
}

void QuinticBasis::append_rows(int segment, std::span<const double> times_s,
                               std::vector<QuinticRow>& rows) const {
    double near[2 * kSupport], inverse[kSupport][kSupport];  // near[kSupport]: where the segment ends
    for (int i = 1; i < 2 * kSupport - 1; ++i) near[i] = time(segment + 1 + i - kSupport);
    for (int j = 1; j < kSupport; ++j)
        for (int r = 0; r < j; ++r) inverse[j][r] = 1 / (near[kSupport + r] - near[kSupport + r - j]);
    const bool folded = (first_is_end_ && segment < 2) || (last_is_end_ && segment > last_ - 3);
    const int first = first_is_end_ ? std::max(0, segment - 2) : segment - 2;
    for (std::size_t begin = 0; begin < times_s.size(); begin += kAtOnce) {
        const std::size_t count = std::min(kAtOnce, times_s.size() - begin);
        Times t, n[kSupport];
        for (std::size_t i = 0; i < kAtOnce; ++i) t[i] = times_s[begin + std::min(i, count - 1)];
        n[0] = Times{} + 1;
        for (int j = 1; j < kSupport; ++j) {
            Times carried{};
            for (int r = 0; r < j; ++r) {
                const Times share = n[r] * inverse[j][r];
                n[r] = carried + (near[kSupport + r] - t) * share;
                carried = (t - near[kSupport - j + r]) * share;
            }
            n[j] = carried;
        }
        for (std::size_t i = 0; i < count; ++i) {
            QuinticRow& row = rows.emplace_back();
            row.first = first;
            for (int r = 0; r < kSupport; ++r) row.weight[r] = n[r][i];
            if (folded) fold_row(segment, row);
        }
    }
}

std::array<double, 7> fifth_derivative_jump(const std::array<double, 11>& time_s) {
    const auto fifth_derivative = [&](std::size_t segment) {  // 0: before the via time, 1: after it
        std::array<std::array<double, 6>, 6> polygon{};
        for (std::size_t i = 0; i < 6; ++i) polygon[i][i] = 1;
        for (std::size_t order = 1; order <= 5; ++order) {
            for (std::size_t i = 0; i + order < 6; ++i) {
                const double span = time_s[segment + i + 5] - time_s[segment + i + order - 1];
                for (std::size_t j = 0; j < 6; ++j)
                    polygon[i][j] = (polygon[i + 1][j] - polygon[i][j]) / span;
            }
        }
        return polygon[0];
    };
    const auto before = fifth_derivative(0), after = fifth_derivative(1);
    std::array<double, 7> jump{};
    for (std::size_t j = 0; j < 6; ++j) {
        jump[j] -= before[j];
        jump[j + 1] += after[j];
    }
    return jump;
}

}  // namespace viaface
