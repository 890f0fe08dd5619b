// The soft shadow that the head at rest casts on itself from the key light, a disc as wide as a window: what
// share of the disc each node sees. Made once for a view. Departures: jaw and lips cast it where they rest;
// between nodes it is linear.
#pragma once

#include <vector>

#include "synth/picture/surface_frame.hpp"
#include "synth/picture/view.hpp"

namespace viaface {

// [nodes of the face] 0 to 1; 1 within the mouth, on lashes and where nothing is in the way.
std::vector<float> key_shares(const Face& face, const View& view);

}  // namespace viaface
