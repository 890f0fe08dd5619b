// A motion and its via points as a drawing [ATR98, Figure 4]: the sound above, then one panel for each
// coordinate chosen, with what was measured, the via points, and the path recovered through them. SVG 1.1.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "viapoints/track.hpp"

namespace viaface {

struct PlottedCoordinate {
    int coordinate = 0;            // of the layout, 0 to 113
    ViaPointTrack via;             // [via points x 1], mm
    std::vector<double> measured;  // mm, one per sample of the plot's time_s
};

struct ViaPlot {
    std::string title;
    double from_s = 0, to_s = 1;  // what is shown
    std::vector<double> time_s;   // of the measured samples, rising
    std::vector<PlottedCoordinate> coordinates;
    std::vector<std::int16_t> sound;  // mono, from time 0; empty: no sound is drawn
    int sound_rate = 16000;           // Hz
};

std::string format_via_plot(const ViaPlot& plot);

// "lip_top_y,chin" as coordinates of the layout; a point by itself means its height. Without a name, the
// lips' and the jaw's that `measured` has. InputError(field, ...) for a name that is none, or not measured.
std::vector<int> plotted_coordinates(const std::string& names, const std::vector<int>& measured,
                                     const std::string& field = "points");

}  // namespace viaface
