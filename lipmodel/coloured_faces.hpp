// Which colour class each face of the lip mesh shows [Basu98, section 5: "we know a priori which triangular
// faces belong to which class"], and how much of it is seen.
#pragma once

#include <vector>

#include "lipmodel/lip_camera.hpp"

namespace viaface {

enum class ColourClass { kLips, kSkin, kOpening };

struct ColouredFace {
    Triangle corners;  // nodes of the lip mesh, counter-clockwise from outside
    ColourClass colour;
};
// Skin and lips of the mesh, then what spans the opening between the inner edges.
const std::vector<ColouredFace>& coloured_faces();

// px^2; 0 when the face is turned away.
double visible_area(const Pixels& pixels, const Triangle& corners);

}  // namespace viaface
