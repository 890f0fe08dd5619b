// A motion held as its via points [ATR98, "Interpolation of via point arrays"].
#pragma once

#include <vector>

#include "viapoints/motion.hpp"

namespace viaface {

struct ViaPointTrack {
    std::vector<double> time_s;  // strictly rising
    RowMatrix points;  // [via points x dimensions]: 114 (mm, head frame), or the components of a PCA basis
};

}  // namespace viaface
