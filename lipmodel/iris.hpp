// Where the iris is in a part of a picture: the place that most slopes from dark to bright point away from,
//   c = arg max sum over x of max(0, d(x) . g(x))^2 (255 - I(c)),  d = (x - c) / |x - c|, g = grad I / |grad
//   I|,
// over the steeper slopes of the part [TimmBarth11]. Cascades tell an eye's place to a tenth of its size; the
// distance between two irises is what millimetres rest on.
#pragma once

#include "lipmodel/class_maps.hpp"

namespace viaface {

// px of the picture; std::invalid_argument for a part that is not in it or smaller than 3 x 3.
Eigen::Vector2d iris_in(const Picture& picture, const PictureBox& part);

}  // namespace viaface
