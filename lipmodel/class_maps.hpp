// How well each class fits, over a part of the picture: convolved with a normalised Hamming kernel, then the
// logarithm. [Basu98, section 5.1: 7 x 7] Between pixel centres the maps are bilinear, so
// that their slope is exact within a cell; beyond their edges the nearest value holds.
#pragma once

#include <vector>

#include "lipmodel/colour_classes.hpp"

namespace viaface {

struct PictureBox {
    int left = 0, top = 0, width = 0, height = 0;  // px
};

struct MapSample {
    double value = 0;
    Eigen::Vector2d slope = Eigen::Vector2d::Zero();  // d/dx, d/dy, per px
};

// Values at pixel centres: pixel (x, y) of the picture has its centre at (x, y).
struct LogMap {
    PictureBox box;
    std::vector<float> values;  // [height x width]

    MapSample at(const Eigen::Vector2d& place) const;  // picture coordinates, px
};

struct ClassMaps {
    LogMap lips, skin, opening;
    double independence = 1;  // of neighbouring values after smoothing: sum of the kernel's squares
};

// Odd: 7 at a mouth 80 px wide, the paper's scale as far as its figures tell, and in proportion; at least 3.
int hamming_size(double mouth_width_px);
std::vector<double> hamming_kernel(int size);  // sums to 1; std::invalid_argument unless odd and positive

// std::invalid_argument for a box that does not lie in the picture or is empty.
ClassMaps class_maps(const Picture& picture, const PictureBox& box, const ColourClasses& classes,
                     int kernel_size);

}  // namespace viaface
