#include "viapoints/analysis.hpp"

#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "viapoints/knot_line.hpp"
#include "viapoints/measured.hpp"
#include "viapoints/spline.hpp"

namespace viaface {
namespace {

using Eigen::Index;

constexpr double kRounding_mm = 1e-9;  // kept free under the bound, for rounding of the final evaluation

void require_valid(const Motion& motion, const AnalysisOptions& options) {
    if (!(options.max_error_mm >= 1e-6 && options.max_error_mm <= 1000)) {
        throw InputError("max_error_mm", std::to_string(options.max_error_mm), "1e-6 to 1000");
    }
    if (!(options.max_gap_ratio >= 2 && options.max_gap_ratio <= 1000)) {
        throw InputError("max_gap_ratio", std::to_string(options.max_gap_ratio), "2 to 1000");
    }
    if (motion.size() < 2)
        throw InputError("motion", std::to_string(motion.size()) + " samples", "two or more");
    if (motion.positions.rows() != static_cast<Index>(motion.size())) {
        throw std::invalid_argument("a motion needs as many positions as times");
    }
    for (std::size_t i = 0; i < motion.size(); ++i) {
        if (!std::isfinite(motion.time_s[i]) || (i > 0 && !(motion.time_s[i] > motion.time_s[i - 1]))) {
            throw InputError("motion",
                             "time " + std::to_string(motion.time_s[i]) + " s at sample " + std::to_string(i),
                             "finite times that rise");
        }
    }
}

constexpr int kShiftRounds = 2;

// The straight line from the first sample to the last.
ViaPointTrack straight(const AnalysisTarget& target) {
    const Index last = target.values.rows() - 1;
    ViaPointTrack track{{target.time_s.front(), target.time_s.back()}, RowMatrix(2, target.values.cols())};
    track.points << target.values.row(0), target.values.row(last);
    return track;
}

double worst(const AnalysisTarget& target, const ViaPointTrack& track) {
    return longest_triple(target.differences(recover(track, target.time_s)));
}

Analysis thinned(const AnalysisTarget& target, double limit_mm, double max_gap_ratio) {
    KnotLine line(target, limit_mm, max_gap_ratio);
    line.fill();
    while (line.thin() > 0) {
    }
    for (int round = 0; round < kShiftRounds; ++round) {
        line.shift();
        line.thin();
    }
    return {.track = line.track(), .evaluations = line.evaluations()};
}

// The track is checked by what its reader will do with it: the spline through it, at every sample.
Analysis extracted(const AnalysisTarget& target, const AnalysisOptions& options) {
    const double limit = options.max_error_mm - kRounding_mm;
    Analysis analysis{.track = straight(target), .evaluations = target.time_s.size()};
    if (target.time_s.size() > 2 && worst(target, analysis.track) > limit)
        analysis = thinned(target, limit, options.max_gap_ratio);
    const RowMatrix differences = target.differences(recover(analysis.track, target.time_s));
    analysis.max_error_mm = longest_triple(differences);
    analysis.rms_error_mm =
        std::sqrt(3 * differences.squaredNorm() / static_cast<double>(differences.size()));
    if (analysis.max_error_mm > options.max_error_mm)
        throw std::runtime_error("via-point analysis exceeds its own bound");
    return analysis;
}

}  // namespace

Analysis analyse_in_full(const Motion& motion, const AnalysisOptions& options) {
    require_valid(motion, options);
    const std::vector<int> points = measured_points(motion.positions, "motion");
    Analysis analysis = extracted({motion.time_s, coordinates_of(motion.positions, points)}, options);
    RowMatrix& packed = analysis.track.points;
    RowMatrix all =
        RowMatrix::Constant(packed.rows(), kCoordinates, std::numeric_limits<double>::quiet_NaN());
    for (std::size_t i = 0; i < points.size(); ++i) {
        all.middleCols<3>(3 * points[i]) = packed.middleCols<3>(static_cast<Index>(3 * i));
    }
    packed = std::move(all);
    return analysis;
}

Analysis analyse_in_full(const Motion& motion, const ConfigurationBasis& basis,
                         const AnalysisOptions& options) {
    require_valid(motion, options);
    const std::vector<int> points = points_of(basis);
    AnalysisTarget target{.time_s = motion.time_s, .values = to_components(basis, motion.positions)};
    target.modes = coordinates_of(basis.modes.transpose(), points);
    target.residual = coordinates_of(motion.positions - to_points(basis, target.values), points);
    const double own = longest_triple(target.residual);
    if (own >= options.max_error_mm) {
        throw InputError("max_error_mm", std::to_string(options.max_error_mm),
                         "more than " + std::to_string(own) + ", the error of the basis alone");
    }
    return extracted(target, options);
}

ViaPointTrack analyse(const Motion& motion, const AnalysisOptions& options) {
    return analyse_in_full(motion, options).track;
}

ViaPointTrack analyse(const Motion& motion, const ConfigurationBasis& basis, const AnalysisOptions& options) {
    return analyse_in_full(motion, basis, options).track;
}

RowMatrix recover(const ViaPointTrack& track, const std::vector<double>& times_s) {
    return MinimumJerkSpline(track).at(times_s);
}

}  // namespace viaface
