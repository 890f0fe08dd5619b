// Via-point analysis: the few points of a recorded motion from which the minimum-jerk spline recovers all of
// it within a stated bound [ATR98, "Extraction of via points"]. The bound is a 3-D distance in mm that holds
// for each point at each sample. Via times are shared by all dimensions and lie on samples; via points need
// not lie on what was measured. Ends are natural.
//
// Departure: inserting where the error is largest and solving the whole spline again is quadratic in length,
// and follows noise. Here
// 1. the spline is solved again eight via points to either side only (an insertion's effect falls to 0.431
//    per via point);
// 2. each via point is then taken out that can be spared, its neighbours moved to a least-squares fit that is
//    weighted more and more towards the worst samples [Lawson61];
// 3. the whole spline is solved and checked at every sample, and what that check finds is inserted again.
// Work is linear in the number of samples.
#pragma once

#include "viapoints/basis.hpp"
#include "viapoints/track.hpp"

namespace viaface {

struct AnalysisOptions {
    double max_error_mm = 0.5;  // 1e-6 to 1000
};

struct Analysis {
    ViaPointTrack track;
    double max_error_mm = 0;      // largest 3-D distance of any point at any sample, recovered from measured
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

// The track's dimensions at rising times: [times x dimensions].
RowMatrix recover(const ViaPointTrack& track, const std::vector<double>& times_s);

}  // namespace viaface
