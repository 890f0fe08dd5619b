// Where the shirt ends, on the head without identity.
#pragma once

#include <Eigen/Core>

namespace viaface {

// mm above the collar's edge: skin where it is positive, cloth below.
template <class Number>
Number above_collar(const Eigen::Matrix<Number, 3, 1>& place) {
    constexpr Number kSlope = 0.33, kHeight = -112.6;  // y + slope * z = height, mm
    return place.y() + kSlope * place.z() - kHeight;
}

}  // namespace viaface
