#include "synth/track/small_picture.hpp"

namespace viaface {

namespace {

std::vector<std::uint8_t> without_alpha(const Frame& frame) {
    std::vector<std::uint8_t> rgb(frame.rgba.size() / 4 * 3);
    for (std::size_t i = 0, k = 0; k < rgb.size(); i += 4, k += 3) {
        for (std::size_t c = 0; c < 3; ++c) rgb[k + c] = frame.rgba[i + c];
    }
    return rgb;
}

}  // namespace

SmallPicture small_picture(const Frame& frame, int factor) {
    SmallPicture made{.width = frame.width / factor, .height = frame.height / factor};
    if (factor == 1) {
        made.rgb = without_alpha(frame);
        return made;
    }
    made.rgb.reserve(3 * static_cast<std::size_t>(made.width) * made.height);
    for (int y = 0; y < made.height; ++y) {
        for (int x = 0; x < made.width; ++x) {
            for (int c = 0; c < 3; ++c) {
                int sum = 0;
                for (int v = 0; v < factor; ++v) {
                    const std::size_t row = static_cast<std::size_t>(y * factor + v) * frame.width;
                    for (int u = 0; u < factor; ++u) sum += frame.rgba[4 * (row + x * factor + u) + c];
                }
                const int pixels = factor * factor;
                made.rgb.push_back(static_cast<std::uint8_t>((sum + pixels / 2) / pixels));
            }
        }
    }
    return made;
}

}  // namespace viaface
