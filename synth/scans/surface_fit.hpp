// The generic head's nodes pulled to a scanned surface, coarse to fine (smooth_fit.hpp), and none of its
// triangles left turned over.
#pragma once

#include "facemodel/smooth_fit.hpp"
#include "synth/scans/generic_head.hpp"

namespace viaface {

// start: [nodes of the face x 3]; pins hold until the surface is near, and hardly after it. What a scanner
// does not see of the generic head (nostrils, the lips' inside, behind the lids' edges) goes on smoothly.
SmoothFit fitted(const GenericHead& generic, const NearestSurface& scan, const Nodes& start,
                 std::vector<Pin> pins);

void weld_nodes(const Face& face, Nodes& nodes);

}  // namespace viaface
