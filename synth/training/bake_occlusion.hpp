// How open the surroundings of each texel are at rest: the cosine-weighted share of directions from which the
// light comes unhindered, measured with one depth map per direction. More weight from above, as indoors.
#pragma once

#include <vector>

#include "synth/picture/surface_frame.hpp"
#include "synth/training/bake_texels.hpp"

namespace viaface {

// [texels] 0 to 1; 1 where no triangle falls. `casters` are triangles of face.rest that keep light off.
std::vector<float> openness(const Face& face, const std::vector<Triangle>& casters, const TexelGrid& grid);

}  // namespace viaface
