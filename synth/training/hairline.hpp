// Where hair grows on the head, and how far it stands off the scalp: short hair with a soft, uneven line.
#pragma once

#include <Eigen/Core>

namespace viaface {

// mm behind the hairline, < 0 in front of it. place: of the resting head, mm.
float hair_depth(const Eigen::Vector3f& place);

float hair_thickness(const Eigen::Vector3f& place);  // mm

}  // namespace viaface
