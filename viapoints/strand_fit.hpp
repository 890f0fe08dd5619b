// Fits a stretch of a minimum-jerk spline to a strand of a motion: coordinates whose distance from what was
// measured is bounded together, the three of a point, or all components of a basis.
//
// Least squares is solved again and again, weighted towards the samples that are missed most, until all are
// within the bound [Lawson61]. A strand's weighted mean of squared distances, at its least, is a lower bound
// of what any spline on these via times could reach at the worst sample: above the limit, the fit is given up
// at once.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "viapoints/motion.hpp"
#include "viapoints/quintic_rows.hpp"

namespace viaface {

using Quad = Eigen::Array4d;  // four dimensions side by side

// How far points are from what was measured, given how far a strand's components are.
struct PointMeasure {
    RowMatrix modes;     // [4 * quads x 3 * points]; empty: the strand is one point
    RowMatrix residual;  // [samples x 3 * points], mm: what the modes do not reach
};

struct Strand {
    int quads = 1;                 // of dimensions, the last filled up with zeros
    std::vector<Quad> value;       // [samples x quads]
    std::vector<double> emphasis;  // [samples], Lawson's weights
    std::vector<double> miss;      // [samples], mm^2: the square of the largest distance under the spline
};

// Samples in a row, and the control points that may change for them.
struct FitStretch {
    std::size_t first_sample = 0;
    std::vector<QuinticRow> rows;  // of the samples from the first on
    int controls = 0;              // control points in all
    int free_begin = 0, free_end = 0;
};

class StrandFit {
  public:
    // Whether control points were found that keep each sample within the limit; fixed: [controls x quads].
    bool within(const Strand& strand, const PointMeasure& measure, const FitStretch& stretch,
                const std::vector<Quad>& fixed, double limit_mm2, int rounds);

    std::vector<Quad> control;     // [free x quads]
    std::vector<double> emphasis;  // [rows]
    std::vector<double> miss;      // [rows], mm^2

  private:
    template <int kQuads>
    bool within(const Strand&, const PointMeasure&, const FitStretch&, const std::vector<Quad>& fixed,
                double limit_mm2, int rounds);
    template <int kQuads>
    void solve(const FitStretch& stretch, int quads);
    template <int kQuads>
    void measure_misses(const PointMeasure& measure, const FitStretch& stretch, int quads);
    void emphasise(double largest);

    std::vector<Quad> target_, left_;  // [rows x quads]: less what is fixed; less the fit
    std::vector<double> band_;         // [free x 6]: the normal equations' upper half-band
};

}  // namespace viaface
