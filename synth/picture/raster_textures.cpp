#include "synth/picture/raster_textures.hpp"

#include <algorithm>
#include <cstring>

namespace viaface {
namespace {

constexpr int kTexel = 8;  // bytes

// A level with its border; rows count from 0 within the border.
struct Canvas {
    int width, height;
    std::vector<std::uint8_t> texels;

    Canvas(int w, int h) : width(w), height(h), texels(std::size_t(w + 2) * (h + 2) * kTexel) {}
    std::uint8_t* row(int y) { return &texels[(std::size_t(y + 1) * (width + 2) + 1) * kTexel]; }
    const std::uint8_t* row(int y) const { return const_cast<Canvas*>(this)->row(y); }

    void close_border() {
        const std::size_t whole = std::size_t(width + 2) * kTexel;
        for (int y = 0; y < height; ++y) {
            std::memcpy(row(y) - kTexel, row(y) + (width - 1) * kTexel, kTexel);
            std::memcpy(row(y) + width * kTexel, row(y), kTexel);
        }
        std::memcpy(row(-1) - kTexel, row(0) - kTexel, whole);
        std::memcpy(row(height) - kTexel, row(height - 1) - kTexel, whole);
    }
};

Canvas largest(const PackedTextures& packed) {
    Canvas canvas(packed.base.width, packed.base.height);
    const std::uint8_t *base = packed.base.pixels.data(), *detail = packed.detail.pixels.data();
    for (int y = 0; y < canvas.height; ++y) {
        std::uint8_t* to = canvas.row(y);
        for (int x = 0; x < canvas.width; ++x, base += 4, detail += 4, to += kTexel) {
            std::memcpy(to, base, 4);
            std::memcpy(to + 4, detail, 4);
        }
    }
    canvas.close_border();
    return canvas;
}

// Means of two by two; the odd last row or column is left out.
Canvas halved(const Canvas& finer) {
    Canvas canvas(std::max(1, finer.width / 2), std::max(1, finer.height / 2));
    const int right = finer.width > 1 ? kTexel : 0, step = finer.width > 1 ? 2 * kTexel : kTexel;
    for (int y = 0; y < canvas.height; ++y) {
        const std::uint8_t* above = finer.row(std::min(2 * y, finer.height - 1));
        const std::uint8_t* below = finer.row(std::min(2 * y + 1, finer.height - 1));
        std::uint8_t* to = canvas.row(y);
        for (int x = 0; x < canvas.width; ++x, above += step, below += step, to += kTexel) {
            for (int i = 0; i < kTexel; ++i)
                to[i] = static_cast<std::uint8_t>(
                    (above[i] + above[i + right] + below[i] + below[i + right] + 2) >> 2);
        }
    }
    canvas.close_border();
    return canvas;
}

}  // namespace

RasterTextures::RasterTextures(const PackedTextures& packed) {
    Canvas canvas = largest(packed);
    for (std::size_t i = 0;; ++i) {
        const raster::Level level{float(canvas.width), float(canvas.height),
                                  std::uint32_t(canvas.width + 2) * kTexel, canvas.texels.data()};
        const bool last = canvas.width == 1 && canvas.height == 1;
        Canvas coarser = last ? Canvas(1, 1) : halved(canvas);
        texels_.push_back(std::move(canvas.texels));
        std::fill(levels_.begin() + i, levels_.end(), level);
        if (last || i + 1 == levels_.size()) return;
        canvas = std::move(coarser);
    }
}

}  // namespace viaface
