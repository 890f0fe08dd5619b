// The minimum-jerk spline of one segment of a stream, by control values: a quintic on the via times as knots,
// C4 there,
//   x(t) = sum over i of N_i(t) q_i,
// N_i the quintic B-splines [deBoor78]. An end rests (velocity and acceleration are zero) where its three
// outermost B-splines count as one; then there is one control value per via point, and it is the spline of
// spline.hpp with ends at rest. An end that moves keeps the three apart: its time stands three times in
// the list of times, once for each control value. Control values, unlike points, are steady under rounding:
// the N_i are 0 or more and sum to 1, so an error of d in each never moves the curve by more than d, however
// the times lie; and N_i ends three via times from i, so that nothing later changes what was drawn.
#pragma once

#include <vector>

#include "viapoints/motion.hpp"

namespace viaface {

// Whether the first (last) time stands three times.
bool moves_first(const std::vector<int>& ticks);
bool moves_last(const std::vector<int>& ticks);

// N_i at times within the via times: [times x control values]. Via times strictly rising but for those of
// ends that move, at least two different ones.
RowMatrix control_weights(const std::vector<int>& via_ticks, const std::vector<double>& at_ticks);

}  // namespace viaface
