// Fits a stretch of a minimum-jerk spline to a strand of a motion: coordinates whose distance from what was
// measured is bounded together, the three of a point, or all components of a basis.
//
// Least squares is solved again and again, weighted towards the samples that are missed most, until all are
// within the bound [Lawson61]. A strand's weighted mean of squared distances, at its least, is a lower bound
// of what any spline on these via times could reach at the worst sample: above the limit, the fit is given up
// at once. As long as samples weigh the same, all strands share one matrix.
#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "viapoints/motion.hpp"
#include "viapoints/quintic_rows.hpp"

namespace viaface {

// How far points are from what was measured, given how far a strand's components are.
struct PointMeasure {
    RowMatrix modes;     // [width x 3 * points]; empty: the strand is one point, or one coordinate
    RowMatrix residual;  // [samples x 3 * points], mm: what the modes do not reach
};

struct Strand {
    int width = 4;                 // of a sample: 1, or a multiple of 4 that is filled up with zeros
    std::vector<double> value;     // [samples x width]
    std::vector<double> emphasis;  // [samples], Lawson's weights
    std::vector<double> miss;      // [samples], mm^2: the square of the largest distance under the spline

    bool even(std::size_t first, std::size_t count) const;  // whether these samples all weigh 1
};

inline constexpr int kProducts = kSupport * (kSupport + 1) / 2 + 1;  // and a zero, for pairs

// Samples in a row, and the control points that may change for them.
struct FitStretch {
    std::size_t first_sample = 0;
    std::vector<QuinticRow> rows;                         // of the samples from the first on
    std::vector<std::array<double, kProducts>> products;  // of each row's weights, [r][s], s >= r
    int controls = 0;                                     // control points in all
    int free_begin = 0, free_end = 0;

    void find_products();  // from rows
};

// The matrix of a stretch's normal equations, a band, and its factors.
class NormalMatrix {
  public:
    // Of samples that weigh `emphasis` each, or 1 where that is empty.
    void factor(const FitStretch& stretch, std::span<const double> emphasis);
    // Takes what is known of the control points that are not free from the right sides [controls x width],
    // kWidth of `width` numbers.
    template <int kWidth>
    void move_held(const FitStretch& stretch, int width, const double* control, double* right) const;
    // From right sides to free control points, kWidth of `width` numbers.
    template <int kWidth>
    void solve(const FitStretch& stretch, int width, double* right, double* control) const;

  private:
    std::vector<double> band_;    // [controls + 5 x 6]: upper half
    std::vector<double> factor_;  // [free x 6]: Cholesky's without roots, the diagonal's inverse first
};

// What fits are worked out in, one after the other: near at hand, as it is the same for all.
struct FitBench {
    NormalMatrix matrix;
    std::vector<double> right, left;  // [controls + 5 x width]; [rows x width], values less the fit
    RowMatrix points;                 // of a basis: [rows x 3 * points]
};

class StrandFit {
  public:
    // Whether control points were found that keep each sample within the limit, those not free as they are in
    // `control`. `even`: the matrix where samples weigh the same, or null.
    bool within(const Strand& strand, const PointMeasure& measure, const FitStretch& stretch,
                const NormalMatrix* even, double limit_mm2, int rounds, FitBench& bench);

    std::vector<double> control;   // [controls + 5 x width], those beyond the line 0
    std::vector<double> emphasis;  // [rows]
    std::vector<double> miss;      // [rows], mm^2

  private:
    template <int kWidth>
    void solve(const Strand& strand, const FitStretch& stretch, const NormalMatrix& matrix, bool even,
               FitBench& bench);
    void measure_misses(const PointMeasure& measure, const FitStretch& stretch, int width, FitBench& bench);
    void emphasise(double largest);
};

}  // namespace viaface
