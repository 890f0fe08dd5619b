// A motion between its samples: through each point's samples runs the cubic of Catmull and Rom with unequal
// steps [CatmullRom74] (the tangent at a sample is that of the parabola through it and its neighbours). Where
// a neighbour is missing the tangent is that of the chord; between two samples of which one is missing the
// point is missing. Before the first and after the last sample their places are held.
#pragma once

#include "viapoints/motion.hpp"

namespace viaface {

// std::invalid_argument for an empty motion or a time that is not finite.
Configuration motion_at(const Motion& motion, double time_s);

// One extra column at a time, linear between samples; NaN where it was not measured.
double extra_at(const std::vector<double>& time_s, const std::vector<double>& values, double at_s);

// Where to find a time: the last sample not after it, and how far on to the next, 0 to 1.
struct BetweenSamples {
    std::size_t sample = 0;
    double share = 0;
};
BetweenSamples between_samples(const std::vector<double>& time_s, double at_s);

}  // namespace viaface
