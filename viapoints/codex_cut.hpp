// Cuts the units of the codex out of a recitation. The times of its via-point analysis are refined so that
// every phone holds its nucleus (the closure of a bilabial or labiodental, else the stillest instant), no two
// via points come closer than kMinViaGap and neighbouring gaps stay within kMaxRecitedGapRatio; their places
// are then read off the motion.
#pragma once

#include <string>
#include <vector>

#include "viapoints/codex.hpp"

namespace viaface {

// A recited sentence or more: the phones, and the motion on the same clock.
struct RecitationTake {
    PhoneSequence phones;
    std::vector<double> time_s;  // a fixed rate of at least 50 Hz that covers the phones
    RowMatrix components;        // [frames x k]
    ViaPointTrack track;         // the via-point analysis of these components
};

// Outside these a phone is an outlier: it stays as context, but is never spoken.
struct CutLimits {
    double shortest_s = 0.030, longest_s = 0.500, longest_pause_s = 6;
    double mended_mm = 0.5;  // via points are added, while there is room, where the spline misses by more
    double farthest_mm = 2;  // of any point from the motion, on the spline through the refined via points
};

struct DroppedPhone {
    std::size_t place;   // in the recitation
    std::string reason;  // "p at 1.234 s: 0.021 s long, 0.030 to 0.500 allowed"
};

struct CutRecitation {
    Recitation recitation;
    std::vector<DroppedPhone> dropped;
    double farthest_mm = 0;  // of any point from the motion, on the spline through the refined via points
};

// Throws std::invalid_argument when the shapes disagree, the rate is not fixed or too low, or the motion does
// not cover the phones.
CutRecitation cut_recitation(const ConfigurationBasis& basis, const RecitationTake& take,
                             const CutLimits& limits = {});

}  // namespace viaface
