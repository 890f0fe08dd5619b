#include "synth/picture/background.hpp"

#include <algorithm>

namespace viaface {
namespace {

constexpr double kMiddle[3] = {121, 125, 129}, kEdge[3] = {52, 55, 61};  // sRGB
constexpr double kGlowLeft = 0.42, kGlowUp = 0.60;                       // of the picture
constexpr double kFall = 1.15;

// Evenly spread in [0, 1) by the golden ratio's cousins in two dimensions (R2 sequence as a mask).
double dither(int x, int y) {
    const double value = 0.7548776662466927 * x + 0.5698402909980532 * y;
    return value - static_cast<double>(static_cast<long>(value));
}

Rgb glow(const View& view, int x, int y) {
    const double shorter = std::min(view.width, view.height);
    const double dx = (x + 0.5 - kGlowLeft * view.width) / shorter;
    const double dy = (y + 0.5 - kGlowUp * view.height) / shorter;
    const double fall = 1 + kFall * (dx * dx + dy * dy);
    const double share = 1 / (fall * fall);
    Rgb colour;
    for (int c = 0; c < 3; ++c) {
        colour[c] = static_cast<std::uint8_t>(kEdge[c] + share * (kMiddle[c] - kEdge[c]) + dither(x, y));
    }
    return colour;
}

}  // namespace

Texture make_background(const View& view) {
    std::optional<Rgb> one = view.background;
    if (!one && view.shown == Shown::kPoints) one = Rgb{0, 0, 0};
    if (!one && view.shown == Shown::kWireframe) one = Rgb{255, 255, 255};
    Texture texture{view.width, view.height, 4, {}};
    texture.pixels.reserve(std::size_t(4) * view.width * view.height);
    for (int y = 0; y < view.height; ++y) {
        for (int x = 0; x < view.width; ++x) {
            const Rgb colour = one ? *one : glow(view, x, y);
            texture.pixels.insert(texture.pixels.end(), {colour[0], colour[1], colour[2], 255});
        }
    }
    return texture;
}

}  // namespace viaface
