#include "viapoints/gaps.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "viapoints/spline.hpp"

namespace viaface {
namespace {

using Eigen::Index;

constexpr double kNeighbourStep = 0.025;  // s, at least, between the neighbours on one side
constexpr int kNeighbours = 3;            // on either side

class PointGaps {
  public:
    PointGaps(PointRecording& recording, std::size_t point)
        : times_(recording.time_s),
          label_(recording.labels[point]),
          places_(recording.positions.middleCols(static_cast<Index>(3 * point), 3)) {}

    // Pairs of the first sample of a gap and the first behind it.
    std::vector<std::pair<Index, Index>> runs() const {
        std::vector<std::pair<Index, Index>> found;
        for (Index i = 0; i < places_.rows(); ++i) {
            if (measured(i)) continue;
            const Index first = i;
            while (i < places_.rows() && !measured(i)) ++i;
            found.emplace_back(first, i);
        }
        const bool never = found.size() == 1 && found[0] == std::pair<Index, Index>{0, places_.rows()};
        return never ? std::vector<std::pair<Index, Index>>{} : found;
    }

    Gap gap(Index first, Index behind) const {
        return {label_, time(std::max<Index>(0, first - 1)), time(std::min(behind, places_.rows() - 1)),
                false};
    }

    void bridge(Index first, Index behind) {
        if (first == 0 || behind == places_.rows()) {
            const RowMatrix held = places_.row(first == 0 ? behind : first - 1);
            for (Index i = first; i < behind; ++i) places_.row(i) = held;
            return;
        }
        std::vector<Index> samples = neighbours(first - 1, -1), after = neighbours(behind, +1);
        std::ranges::reverse(samples);
        samples.insert(samples.end(), after.begin(), after.end());
        ViaPointTrack track{{}, places_(samples, Eigen::all)};
        for (const Index sample : samples) track.time_s.push_back(time(sample));
        const MinimumJerkSpline spline(track);
        for (Index i = first; i < behind; ++i) places_.row(i) = spline.at(time(i)).transpose();
    }

  private:
    double time(Index i) const { return times_[static_cast<std::size_t>(i)]; }
    bool measured(Index i) const { return places_.row(i).allFinite(); }

    // Measured samples from one on, away from the gap.
    std::vector<Index> neighbours(Index from, Index step) const {
        std::vector<Index> found = {from};
        for (Index i = from + step; i >= 0 && i < places_.rows() && found.size() < kNeighbours; i += step) {
            if (!measured(i)) break;
            if (std::abs(time(i) - time(found.back())) >= kNeighbourStep) found.push_back(i);
        }
        return found;
    }

    const std::vector<double>& times_;
    const std::string& label_;
    Eigen::Ref<RowMatrix, 0, Eigen::OuterStride<>> places_;  // [samples x 3]
};

}  // namespace

std::vector<Gap> bridge_gaps(PointRecording& recording, double longest_s, LongGaps longer,
                             const std::string& field) {
    std::vector<Gap> gaps;
    for (std::size_t p = 0; p < recording.labels.size(); ++p) {
        PointGaps point(recording, p);
        for (const auto& [first, behind] : point.runs()) {
            Gap gap = point.gap(first, behind);
            gap.bridged = gap.length_s() <= longest_s;
            if (!gap.bridged && longer == LongGaps::kRefuse)
                throw InputError(
                    field,
                    gap.label + " missing from " + std::to_string(gap.from_s) + " to " +
                        std::to_string(gap.to_s) + " s",
                    "gaps up to " + std::to_string(longest_s) + " s (--longest-gap, --leave-gaps)");
            if (gap.bridged) point.bridge(first, behind);
            gaps.push_back(std::move(gap));
        }
    }
    return gaps;
}

}  // namespace viaface
