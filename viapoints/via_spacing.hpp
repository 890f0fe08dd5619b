// How close via points may come and how unevenly they may lie. Freely placed knots overshoot: at gap ratios
// near 28 the spline's Lebesgue constant is 92, at 3 it is 18.
#pragma once

#include <cstdint>
#include <vector>

#include "viapoints/track.hpp"

namespace viaface {

inline constexpr double kMinViaGap = 0.020;       // s, where two units meet
inline constexpr double kMinViaGapInRun = 0.010;  // s, within what was recited together
inline constexpr double kMaxViaGap = 0.250;       // s: what rings in a longer gap is seen
inline constexpr double kMaxViaGapRatio = 3;      // of neighbouring gaps in what is spoken
inline constexpr double kMaxRecitedGapRatio =
    2.5;  // in what is recited: the room between is for changed durations

// What a via point is worth where two come too close.
enum class ViaRank : std::uint8_t { kPassing, kNucleus, kLabiodental, kBilabial, kRest };

struct RankedTrack {
    ViaPointTrack track;
    std::vector<ViaRank> rank;  // one per via point
    std::vector<int> run;       // one per via point, rising: equal for those that were recited together
};

// The track without gaps under min_gap, or min_gap_in_run inside a run: of two that come too close the higher
// rank stays as it is, equals meet half way in time and place (two lips that press still press half way
// between; of two at rest the earlier stays). Times may repeat, but never fall.
RankedTrack thinned(const RankedTrack& ranked, double min_gap, double min_gap_in_run);

// The times to add so that no gap exceeds kMaxViaGap, nor max_ratio times its neighbour; each new gap is at
// least half max_ratio times a gap that was there, or half kMaxViaGap.
std::vector<double> grading_times(const std::vector<double>& time_s, double max_ratio);

// The monotone cubic through the track's points [Fritsch and Butland 1984]: passes between two neighbours
// without leaving their range in any dimension. What a point added by grading takes as its place.
class MonotoneCubic {
  public:
    explicit MonotoneCubic(const ViaPointTrack& track);
    Eigen::RowVectorXd at(double time_s) const;

  private:
    const ViaPointTrack& track_;
    RowMatrix slope_;  // [via points x dimensions], per s
};

}  // namespace viaface
