// Fits a stretch of a minimum-jerk spline to strands of a motion: coordinates whose distance from what was
// measured is bounded together, the three of a point, or all components of a basis. Strands are fitted four
// side by side, as braids.
//
// Least squares is solved again and again, weighted towards the samples that are missed most, until all are
// within the bound [Lawson61]. A strand's weighted mean of squared distances, at its least, is a lower bound
// of what any spline on these via times could reach at the worst sample: above the limit, the fit is given up
// at once. As long as samples weigh the same, all braids share one matrix.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "viapoints/motion.hpp"
#include "viapoints/strand_kernel.hpp"

namespace viaface {

// How far points are from what was measured, given how far a basis's components are.
struct PointMeasure {
    RowMatrix modes;     // [4 * vectors x 3 * points]; empty: strands are points, or one coordinate
    RowMatrix residual;  // [samples x 3 * points], mm: what the modes do not reach
};

// Points, one to a lane; or one strand of a basis or a coordinate, whose components fill the lanes.
struct Braid {
    int vectors = 3;              // of a sample
    std::vector<Lanes> value;     // [samples x vectors], filled up with zeros
    std::vector<Lanes> emphasis;  // [samples], Lawson's weights
    std::vector<Lanes> miss;      // [samples], mm^2: the square of the largest distance under the spline
};

// Samples in a row, and the control points that may change for them.
struct FitStretch {
    std::size_t first_sample = 0;
    std::vector<QuinticRow> rows;        // of the samples from the first on
    std::vector<std::ptrdiff_t> starts;  // of rows from knot to knot, and the end of the last
    int controls = 0;                    // control points in all
    int free_begin = 0, free_end = 0;

    FitRows view() const {
        return {rows.data(), starts.data(), std::ssize(starts) - 1, controls, free_begin, free_end};
    }
};

// The matrix of a stretch's normal equations, a band, and its factors.
struct NormalMatrix {
    std::vector<Lanes> band;     // [controls + 5 x 6]: upper half
    std::vector<Lanes> factors;  // [free x 6]

    void factor(const StrandKernel& kernel, const FitStretch& stretch, const Lanes* emphasis);
};

// What fits are worked out in, one after the other: near at hand, as it is the same for all.
struct FitBench {
    const StrandKernel* kernel;
    NormalMatrix matrix = {};
    std::vector<Lanes> right = {},
                       left =
                           {};  // [controls + 5 x vectors]; [rows x vectors], of a basis: values less the fit
    RowMatrix points = {};      // of a basis: [rows x 3 * points]
};

class BraidFit {
  public:
    // Whether control points were found that keep each sample within the limit, those not free as they are in
    // `control`. `even`: the matrix if all samples weigh the same, or null.
    bool within(const Braid& braid, const PointMeasure& measure, const FitStretch& stretch,
                const NormalMatrix* even, double limit_mm2, int rounds, FitBench& bench);

    std::vector<Lanes> control;   // [controls + 5 x vectors], those beyond the line 0
    std::vector<Lanes> emphasis;  // [rows], or none where the braid's own served
    std::vector<Lanes> miss;      // [rows], mm^2

  private:
    void measure_misses(const Braid& braid, const PointMeasure& measure, const FitStretch& stretch,
                        FitBench& bench);
    void emphasise(const Braid& braid, const FitStretch& stretch, const Lanes& largest,
                   const FitBench& bench);
};

}  // namespace viaface
