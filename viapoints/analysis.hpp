// Via-point analysis: the few points of a recorded motion from which the minimum-jerk spline recovers all of
// it within a stated bound [ATR98, "Extraction of via points"]. The bound is a 3-D distance in mm that holds
// for each point at each sample. Via times are shared by all dimensions and lie on samples; via points need
// not lie on what was measured. Ends are natural.
//
// Departure: inserting where the error is largest and solving the whole spline again is quadratic in length,
// and follows noise. Here
// 1. gaps are halved until least squares over all via times stays within the bound;
// 2. via points go, the least important first, where a stretch of the spline can be fitted without them
//    (strand_fit.hpp): each point by itself, weighted more and more towards its worst samples [Lawson61];
// 3. via times shift by a sample where that relieves the worst samples, and what can be spared then goes too.
// Work is linear in the number of samples. Neighbouring gaps differ by a limited ratio: freely placed via
// points overshoot, and magnify noise.
#pragma once

#include "viapoints/basis.hpp"
#include "viapoints/track.hpp"

namespace viaface {

struct AnalysisOptions {
    double max_error_mm = 0.5;  // 1e-6 to 1000
    double max_gap_ratio = 4;   // of neighbouring gaps between via times, 2 to 1000; samples may impose more
};

struct Analysis {
    ViaPointTrack track;
    double max_error_mm = 0;      // largest 3-D distance of any point at any sample, recovered from measured
    double worst_time_s = 0;      // where that is
    int worst_point = 0;          // in the layout
    double rms_error_mm = 0;      // root mean square of those distances
    std::size_t evaluations = 0;  // sample evaluations it took: the measure of work
};

// The track holds 114 dimensions; points that were never measured are NaN in it. InputError for fewer than
// two samples, times that do not rise, points with gaps, and a bound out of range.
Analysis analyse_in_full(const Motion& motion, const AnalysisOptions& options = {});
ViaPointTrack analyse(const Motion& motion, const AnalysisOptions& options = {});

// The track holds the basis's components; its points are to_points(basis, recover(track, times)). The bound
// includes the basis's own error: InputError("max_error_mm", ...) when that alone exceeds it.
Analysis analyse_in_full(const Motion& motion, const ConfigurationBasis& basis,
                         const AnalysisOptions& options = {});
ViaPointTrack analyse(const Motion& motion, const ConfigurationBasis& basis,
                      const AnalysisOptions& options = {});

// The same with via times of its own for each dimension: a track of one dimension each, those of points that
// were never measured empty. A coordinate keeps to bound / sqrt(3); a component to what leaves each point
// within the bound when all components miss by as much at once.
struct SeparateAnalysis {
    std::vector<ViaPointTrack> tracks;  // one per coordinate of the layout, or component
    double max_error_mm = 0, worst_time_s = 0, rms_error_mm = 0;
    int worst_point = 0;
    std::size_t evaluations = 0;
};
SeparateAnalysis analyse_separately(const Motion& motion, const AnalysisOptions& options = {});
SeparateAnalysis analyse_separately(const Motion& motion, const ConfigurationBasis& basis,
                                    const AnalysisOptions& options = {});

// The track's dimensions at rising times: [times x dimensions].
RowMatrix recover(const ViaPointTrack& track, const std::vector<double>& times_s);

}  // namespace viaface
