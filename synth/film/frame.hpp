// A picture in memory: one frame is held at a time, never the clip. Rows of 4 bytes per pixel: red, green,
// blue, alpha, 0 to 255, sRGB. Video formats drop alpha; PNG keeps it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace viaface {

struct Frame {
    int width = 0, height = 0;       // pixels
    std::vector<std::uint8_t> rgba;  // [height x width x 4], top row first
};

// Pixels owned elsewhere. A stride below zero reads rows stored bottom first without a copy.
struct FrameView {
    int width = 0, height = 0;
    const std::uint8_t* top_row = nullptr;
    std::ptrdiff_t stride = 0;  // bytes from a row to the one below it
};

inline FrameView view(const Frame& frame) {
    return {frame.width, frame.height, frame.rgba.data(), std::ptrdiff_t{4} * frame.width};
}

// Rows as OpenGL reads them back: the bottom row first in memory.
inline FrameView bottom_up_view(int width, int height, const std::uint8_t* rgba) {
    const std::ptrdiff_t row = std::ptrdiff_t{4} * width;
    return {width, height, rgba + row * (height - 1), -row};
}

}  // namespace viaface
