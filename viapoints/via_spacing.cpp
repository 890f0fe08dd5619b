#include "viapoints/via_spacing.hpp"

#include <algorithm>
#include <stdexcept>

namespace viaface {
namespace {

struct RankedVia {
    double time;
    Eigen::RowVectorXd point;
    ViaRank rank;
    int run;
};

RankedVia one_of(const RankedVia& earlier, const RankedVia& later) {
    if (earlier.rank > later.rank || earlier.rank == ViaRank::kRest) return earlier;
    if (later.rank > earlier.rank) return later;
    return {(earlier.time + later.time) / 2, (earlier.point + later.point) / 2, earlier.rank, earlier.run};
}

// One pass of grading; the same times when nothing is left to do.
std::vector<double> graded_once(const std::vector<double>& times, double max_ratio) {
    constexpr double kTolerance = 1 + 1e-6;
    const auto gap = [&](std::size_t i) { return times[i + 1] - times[i]; };
    std::vector<double> result;
    for (std::size_t i = 0; i + 1 < times.size(); ++i) {
        result.push_back(times[i]);
        const double left = i > 0 ? gap(i - 1) : gap(i);
        const double right = i + 2 < times.size() ? gap(i + 1) : gap(i);
        const double allowed = std::min(max_ratio * std::min(left, right), kMaxViaGap);
        if (gap(i) <= allowed * kTolerance) continue;
        const double offset = std::min(allowed, gap(i) / 2);
        result.push_back(left <= right ? times[i] + offset : times[i + 1] - offset);
    }
    result.push_back(times.back());
    return result;
}

double harmonic_slope(double h0, double d0, double h1, double d1) {
    if (d0 * d1 <= 0) return 0;
    const double w0 = h0 + 2 * h1, w1 = 2 * h0 + h1;
    return (w0 + w1) / (w0 / d0 + w1 / d1);
}

}  // namespace

RankedTrack thinned(const RankedTrack& ranked, double min_gap, double min_gap_in_run) {
    std::vector<RankedVia> kept;
    for (std::size_t i = 0; i < ranked.rank.size(); ++i) {
        RankedVia via{ranked.track.time_s[i], ranked.track.points.row(static_cast<Eigen::Index>(i)),
                      ranked.rank[i], ranked.run[i]};
        const auto too_close = [&](const RankedVia& before) {
            return via.time - before.time < (via.run == before.run ? min_gap_in_run : min_gap);
        };
        while (!kept.empty() && too_close(kept.back())) {
            via = one_of(kept.back(), via);
            kept.pop_back();
        }
        kept.push_back(std::move(via));
    }
    RankedTrack result{{{}, RowMatrix(std::ssize(kept), ranked.track.points.cols())}, {}, {}};
    for (const RankedVia& via : kept) {
        result.track.points.row(std::ssize(result.rank)) = via.point;
        result.track.time_s.push_back(via.time);
        result.rank.push_back(via.rank);
        result.run.push_back(via.run);
    }
    return result;
}

std::vector<double> grading_times(const std::vector<double>& time_s, double max_ratio) {
    if (!(max_ratio >= 2))
        throw std::invalid_argument("grading_times: a ratio under 2 cannot be reached by adding");
    if (time_s.empty()) return {};
    std::vector<double> graded = time_s;
    for (std::vector<double> next = graded_once(graded, max_ratio); next.size() > graded.size();
         next = graded_once(graded, max_ratio)) {
        graded = std::move(next);
    }
    std::vector<double> added;
    std::set_difference(graded.begin(), graded.end(), time_s.begin(), time_s.end(),
                        std::back_inserter(added));
    return added;
}

MonotoneCubic::MonotoneCubic(const ViaPointTrack& track) : track_(track), slope_(track.points) {
    slope_.setZero();
    for (Eigen::Index i = 1; i + 1 < slope_.rows(); ++i) {
        const auto at = static_cast<std::size_t>(i);
        const double h0 = track.time_s[at] - track.time_s[at - 1],
                     h1 = track.time_s[at + 1] - track.time_s[at];
        for (Eigen::Index d = 0; d < slope_.cols(); ++d) {
            const double before = (track.points(i, d) - track.points(i - 1, d)) / h0;
            const double after = (track.points(i + 1, d) - track.points(i, d)) / h1;
            slope_(i, d) = harmonic_slope(h0, before, h1, after);
        }
    }
}

Eigen::RowVectorXd MonotoneCubic::at(double time_s) const {
    const auto& times = track_.time_s;
    const auto after = std::upper_bound(times.begin(), times.end(), time_s);
    if (after == times.begin()) return track_.points.row(0);
    if (after == times.end()) return track_.points.row(track_.points.rows() - 1);
    const Eigen::Index i = after - times.begin() - 1;
    const double h = *after - *(after - 1), x = (time_s - *(after - 1)) / h;
    const double q1 = x * x * (3 - 2 * x), m0 = h * x * (1 - x) * (1 - x), m1 = -h * x * x * (1 - x);
    return (1 - q1) * track_.points.row(i) + q1 * track_.points.row(i + 1) + m0 * slope_.row(i) +
           m1 * slope_.row(i + 1);
}

}  // namespace viaface
