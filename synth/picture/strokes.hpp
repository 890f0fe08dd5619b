// Dots and lines drawn into a picture, their edges smoothed by distance: a pixel takes the share by which the
// stroke's border has passed its middle.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>

#include "synth/picture/view.hpp"

namespace viaface {

// Pixels of 4 bytes, bottom row first.
struct Canvas {
    int width, height;
    std::uint8_t* rgba;

    void lay(int x, int y, const Rgb& colour, float share) const {
        std::uint8_t* pixel = rgba + 4 * (std::size_t(y) * width + x);
        for (int c = 0; c < 3; ++c)
            pixel[c] = static_cast<std::uint8_t>(pixel[c] + share * (float(colour[c]) - pixel[c]) + 0.5f);
    }
};

// Calls visit(x, y, distance) for the pixels whose middles are at most `reach` from the stretch from `a` to
// `b`, from the lower left corner; `along` in visit(x, y, distance, along) is 0 at `a` and 1 at `b`.
template <class Visit>
void for_pixels_near(const Canvas& canvas, const Eigen::Vector2f& a, const Eigen::Vector2f& b, float reach,
                     const Visit& visit) {
    const Eigen::Vector2f low = a.cwiseMin(b).array() - reach, high = a.cwiseMax(b).array() + reach;
    const auto pixel = [](float place, int size) {
        return static_cast<int>(std::clamp(place, 0.0f, static_cast<float>(size)));
    };
    const Eigen::Vector2f way = b - a;
    const float squared = way.squaredNorm();
    for (int y = pixel(low.y(), canvas.height); y < pixel(high.y() + 1, canvas.height); ++y) {
        for (int x = pixel(low.x(), canvas.width); x < pixel(high.x() + 1, canvas.width); ++x) {
            const Eigen::Vector2f middle(x + 0.5f, y + 0.5f);
            const float along = squared > 0 ? std::clamp(way.dot(middle - a) / squared, 0.0f, 1.0f) : 0;
            const float distance = (middle - a - along * way).norm();
            if (distance < reach) visit(x, y, distance, along);
        }
    }
}

}  // namespace viaface
