// Quintic B-splines over via times, with natural ends (x''' = x'''' = 0) folded in: the minimum-jerk splines
// through given via times are exactly their combinations, one control point to a via time. A change of one
// control point reaches three segments to its left and three to its right, no farther.
//
// Departure: [ATR98] solves for the spline through points; a least-squares fit needs a basis of local
// support. Recursion by [deBoor72].
#pragma once

#include <array>
#include <span>
#include <vector>

namespace viaface {

inline constexpr int kSupport = 6;  // control points that a sample depends on

struct QuinticRow {
    double weight[kSupport];
    int first;  // the control point that weight[0] belongs to
};

// Via times in a row, three or more: a line's, or a part of it. At ends that are not the line's, rows are
// right only from the fifth segment inwards.
class QuinticBasis {
  public:
    QuinticBasis(std::span<const double> time_s, bool first_is_end, bool last_is_end);

    // Appends the rows of the times given, which lie from via time `segment` to the next. Rows may name up to
    // five control points beyond the last: their weights are zero.
    void append_rows(int segment, std::span<const double> times_s, std::vector<QuinticRow>& rows) const;

  private:
    // The two outermost coefficients of a basis without end conditions as combinations of the next three.
    using Fold = std::array<std::array<double, 3>, 2>;
    using Weights = std::array<double, 12>;
    static Fold fold(const std::array<double, 5>& distance);
    double time(int i) const;
    void fold_ends(int segment, Weights& weight) const;
    void fold_row(int segment, QuinticRow& row) const;

    std::span<const double> time_s_;
    int last_;
    bool first_is_end_, last_is_end_;
    Fold first_fold_{}, last_fold_{};
};

// A 120th of the jump of the fifth derivative at the sixth of eleven via times (a line's ends repeated), as
// weights of
// the control points of the third to the ninth: how much the spline needs a via point there.
std::array<double, 7> fifth_derivative_jump(const std::array<double, 11>& time_s);

}  // namespace viaface
