// How well a codex learned from some takes speaks the others: each left-out take is spoken at its own phone
// times, and set beside its own motion at every sample between its outer pauses.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "synth/learn/recorded_takes.hpp"

namespace viaface {

// Of one point, over all takes left out. m measured, s spoken, each three numbers a sample:
//   r = sum (m - mean m).(s - mean s) / sqrt(sum |m - mean m|^2 sum |s - mean s|^2)
//   rms = sqrt(mean |m - s|^2), spread = sqrt(mean |m - mean m|^2)
struct PointFigures {
    int point = 0;  // of the layout
    double correlation = 0, rms_mm = 0, spread_mm = 0;
};

// Likewise of the opening between the lips (innermost pair measured, along y) and of the mouth's width (along
// x): what is seen of a mouth from the front.
struct LengthFigures {
    std::string name;
    double correlation = 0, rms_mm = 0, spread_mm = 0;
};

// Of one take left out.
struct TakeFigures {
    std::string name;
    std::vector<LengthFigures> lengths;  // those measured
    double rms_mm = 0, spread_mm = 0;    // over all points
};

struct HeldOutFigures {
    std::size_t learned = 0;  // takes
    std::vector<TakeFigures> left_out;
    std::vector<PointFigures> points;         // those measured, in the layout's order
    std::vector<LengthFigures> lengths;       // those measured
    std::array<int, 3> phones_at_level = {};  // exact, class, half
    double rms_mm = 0, spread_mm = 0;         // over all points
};

// Every n-th take of the list, 1/n being nearest to the share; at least one is left out and one learned from.
// InputError(field, ...) for a share outside 0.01 to 0.5, and for fewer than two takes.
HeldOutFigures check_held_out(const RecordedTakes& takes, double share, const std::string& field,
                              const LearningOptions& options = {});

std::string as_text(const HeldOutFigures& figures);

}  // namespace viaface
