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
    const RowMatrix differences = target.differences(recover(track, target.time_s));
    return differences.cols() % 3 == 0 ? longest_triple(differences) : differences.cwiseAbs().maxCoeff();
}

ViaPointTrack thinned(const AnalysisTarget& target, double limit_mm, double max_gap_ratio,
                      std::size_t& evaluations) {
    KnotLine line(target, limit_mm, max_gap_ratio);
    line.fill();
    while (line.thin() > 0) {
    }
    for (int round = 0; round < kShiftRounds; ++round) {
        line.shift();
        line.thin();
    }
    evaluations += line.evaluations();
    return line.track();
}

ViaPointTrack within(const AnalysisTarget& target, double bound_mm, double max_gap_ratio,
                     std::size_t& evaluations) {
    const double limit = bound_mm - kRounding_mm;
    evaluations += target.time_s.size();
    ViaPointTrack line = straight(target);
    if (target.time_s.size() == 2 || worst(target, line) <= limit) return line;
    return thinned(target, limit, max_gap_ratio, evaluations);
}

// Checked by what the track's reader will do with it: the spline through it, at every sample.
template <class Result>
void check(Result& result, const AnalysisTarget& target, const RowMatrix& recovered,
           const std::vector<int>& points, double bound_mm) {
    const RowMatrix differences = target.differences(recovered);
    for (Index i = 0; i < differences.rows(); ++i) {
        for (std::size_t p = 0; p < points.size(); ++p) {
            const double distance = differences.block<1, 3>(i, static_cast<Index>(3 * p)).norm();
            if (distance <= result.max_error_mm) continue;
            result.max_error_mm = distance;
            result.worst_time_s = target.time_s[static_cast<std::size_t>(i)];
            result.worst_point = points[p];
        }
    }
    result.rms_error_mm = std::sqrt(3 * differences.squaredNorm() / static_cast<double>(differences.size()));
    if (result.max_error_mm > bound_mm) throw std::runtime_error("via-point analysis exceeds its own bound");
}

Analysis extracted(const AnalysisTarget& target, const std::vector<int>& points,
                   const AnalysisOptions& options) {
    Analysis analysis;
    analysis.track = within(target, options.max_error_mm, options.max_gap_ratio, analysis.evaluations);
    check(analysis, target, recover(analysis.track, target.time_s), points, options.max_error_mm);
    return analysis;
}

SeparateAnalysis extracted_separately(const AnalysisTarget& target, const std::vector<int>& points,
                                      double bound_mm, const AnalysisOptions& options) {
    SeparateAnalysis analysis;
    RowMatrix recovered(target.values.rows(), target.values.cols());
    for (Index d = 0; d < target.values.cols(); ++d) {
        analysis.tracks.push_back(within({target.time_s, target.values.col(d)}, bound_mm,
                                         options.max_gap_ratio, analysis.evaluations));
        recovered.col(d) = recover(analysis.tracks.back(), target.time_s);
    }
    check(analysis, target, recovered, points, options.max_error_mm);
    return analysis;
}

// Throws when the basis by itself exceeds the bound.
AnalysisTarget in_basis(const Motion& motion, const ConfigurationBasis& basis, const std::vector<int>& points,
                        double bound_mm) {
    AnalysisTarget target{.time_s = motion.time_s, .values = to_components(basis, motion.positions)};
    target.modes = coordinates_of(basis.modes.transpose(), points);
    target.residual = coordinates_of(motion.positions - to_points(basis, target.values), points);
    const double own = longest_triple(target.residual);
    if (own >= bound_mm) {
        throw InputError("max_error_mm", std::to_string(bound_mm),
                         "more than " + std::to_string(own) + ", the error of the basis alone");
    }
    return target;
}

// How far a point can be off when every component is off by 1.
double largest_reach(const RowMatrix& modes) {
    double largest = 0;
    for (Index p = 0; p < modes.cols(); p += 3)
        largest = std::max(largest, modes.middleCols<3>(p).rowwise().norm().sum());
    return largest;
}

}  // namespace

Analysis analyse_in_full(const Motion& motion, const AnalysisOptions& options) {
    require_valid(motion, options);
    const std::vector<int> points = measured_points(motion.positions, "motion");
    Analysis analysis = extracted({motion.time_s, coordinates_of(motion.positions, points)}, points, options);
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
    return extracted(in_basis(motion, basis, points, options.max_error_mm), points, options);
}

SeparateAnalysis analyse_separately(const Motion& motion, const AnalysisOptions& options) {
    require_valid(motion, options);
    const std::vector<int> points = measured_points(motion.positions, "motion");
    SeparateAnalysis analysis =
        extracted_separately({motion.time_s, coordinates_of(motion.positions, points)}, points,
                             options.max_error_mm / std::sqrt(3.0), options);
    std::vector<ViaPointTrack> all(kCoordinates);
    for (std::size_t d = 0; d < analysis.tracks.size(); ++d)
        all[3 * static_cast<std::size_t>(points[d / 3]) + d % 3] = std::move(analysis.tracks[d]);
    analysis.tracks = std::move(all);
    return analysis;
}

SeparateAnalysis analyse_separately(const Motion& motion, const ConfigurationBasis& basis,
                                    const AnalysisOptions& options) {
    require_valid(motion, options);
    const std::vector<int> points = points_of(basis);
    const AnalysisTarget target = in_basis(motion, basis, points, options.max_error_mm);
    const double left = options.max_error_mm - longest_triple(target.residual);
    return extracted_separately(target, points, left / std::max(1e-9, largest_reach(target.modes)), options);
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
