#include "viapoints/quintic_rows.hpp"

#include <algorithm>
#include <utility>

namespace viaface {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

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

void QuinticBasis::append_rows(int segment, std::span<const double> times_s,
                               std::vector<QuinticRow>& rows) const {
    double inverse[kSupport][kSupport], left_of[kSupport], right_of[kSupport];
    for (int j = 1; j < kSupport; ++j) {
        left_of[j] = time(segment + 1 - j);
        right_of[j] = time(segment + j);
        for (int r = 0; r < j; ++r) inverse[j][r] = 1 / (time(segment + r + 1) - time(segment + 1 - j + r));
    }
    const bool folded = (first_is_end_ && segment < 2) || (last_is_end_ && segment > last_ - 3);
    const int first = first_is_end_ ? std::max(0, segment - 2) : segment - 2;
    for (const double t : times_s) {
        std::array<double, kSupport> n;
        n[0] = 1;
        for (int j = 1; j < kSupport; ++j) {
            double carried = 0;
            for (int r = 0; r < j; ++r) {
                const double share = n[at(r)] * inverse[j][r];
                n[at(r)] = carried + (right_of[r + 1] - t) * share;
                carried = (t - left_of[j - r]) * share;
            }
            n[at(j)] = carried;
        }
        if (folded) {
            Weights weight{};
            std::copy(n.begin(), n.end(), weight.begin() + 2);
            fold_ends(segment, weight);
            std::copy_n(weight.begin() + first - segment + 4, kSupport, n.begin());
        }
        rows.push_back({n, first});
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
