// How far a node must be from its rest to be drawn away from it. What an eye follows, the lips and what is
// round them and round the eyes, moves from the least way on; skin and clothing further off only follow the
// jaw by a hair, and stand still until that shows.
#pragma once

#include "facemodel/face.hpp"

namespace viaface {

inline constexpr double kLeastWay = 0.1;  // pixels
inline constexpr double kLeastWayFarOff = 1.0;

// [nodes], mm, smooth over the face; `pixel` is the size of one at the face, mm.
Eigen::VectorXd least_ways(const Face& face, double pixel);

// The share of a node's way that is drawn: none up to the least one, then 1 - (least / way)^2, so that what
// goes far goes all of it: a way of ten least ones is drawn within a hundredth.
inline double drawn_share(double squared_way, double least) {
    return squared_way > least * least ? 1 - least * least / squared_way : 0;
}

}  // namespace viaface
