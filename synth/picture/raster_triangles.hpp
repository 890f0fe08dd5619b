// Triangles on the grid of corners: a walk over the samples that they cover. For raster_kernel.cpp alone.
#pragma once

#include "synth/picture/raster_scene.hpp"
#include "synth/picture/raster_wide.hpp"

namespace viaface::raster::VIAFACE_KERNEL {
namespace {

constexpr int kBlock = 16;  // pixels: edge functions stay within 32 bits

// Places of the lanes of a vector, in eighths of a pixel from the first pixel's middle.
struct Lanes {
    EightInt right, up;
    std::int32_t pixels;
};
constexpr Lanes kMiddles = {{0, 8, 16, 24, 32, 40, 48, 56}, {}, 8};
constexpr Lanes kTwoPixels = {{-1, 3, -3, 1, 7, 11, 5, 9}, {-3, -1, 1, 3, -3, -1, 1, 3}, 2};

// An edge function of a triangle that may be large, at a pixel's middle: its sign is that of the exact one.
VIAFACE_INLINE std::int32_t start_of_large(const Triangle& t, const Place& on, int edge, std::int32_t x,
                                           std::int32_t y) {
    constexpr std::int64_t kFar = 1 << 30;
    const std::int64_t right = t.right[edge], up = t.up[edge];
    const bool owns = right > 0 || (right == 0 && up < 0);
    const std::int64_t exact = right * (std::int64_t(x) * kSteps + kSteps / 2 - on.x) +
                               up * (std::int64_t(y) * kSteps + kSteps / 2 - on.y) - !owns;
    return std::int32_t(smaller(larger(exact >> 4, -kFar), kFar));
}
static_assert(8 << 4 == kSteps);

VIAFACE_INLINE FourInt starts_at(const Scene& scene, std::uint32_t facet, std::int32_t x, std::int32_t y) {
    const Triangle& t = scene.triangles.triangles[facet];
    const Bounds& box = scene.triangles.boxes[facet];
    if (t.small != 0) {
        return load<FourInt>(t.first) +
               (load<FourInt>(t.right) * (x - box.left) + load<FourInt>(t.up) * (y - box.bottom)) * 8;
    }
    const auto& [a, b, c] = scene.facets[facet].node;
    return FourInt{start_of_large(t, scene.nodes[b].place, 0, x, y),
                   start_of_large(t, scene.nodes[c].place, 1, x, y),
                   start_of_large(t, scene.nodes[a].place, 2, x, y)};
}

// Rows of vectors over a block of a triangle, from below.
struct Walk {
    EightInt edges[3];     // below zero in the lanes of places that are not within the triangle
    EightInt right[3];     // from a vector to the next
    EightInt up[3];        // from a row to the next
    Eight across, height;  // pixels from the middle of the box's lower left pixel

    VIAFACE_INLINE Walk(const Scene& scene, std::uint32_t facet, const Lanes& lanes, std::int32_t x,
                        std::int32_t y)
        : across(__builtin_convertvector(lanes.right, Eight) * 0.125f +
                 float(x - scene.triangles.boxes[facet].left)),
          height(__builtin_convertvector(lanes.up, Eight) * 0.125f +
                 float(y - scene.triangles.boxes[facet].bottom)) {
        const Triangle& t = scene.triangles.triangles[facet];
        const FourInt starts = starts_at(scene, facet, x, y);
        for (int i = 0; i < 3; ++i) {
            edges[i] = eight(starts[i]) + lanes.right * t.right[i] + lanes.up * t.up[i];
            right[i] = eight(8 * lanes.pixels * t.right[i]);
            up[i] = eight(8 * t.up[i]);
        }
    }

    VIAFACE_INLINE EightInt outside() const { return edges[0] | edges[1] | edges[2]; }
    VIAFACE_INLINE void go_right(float pixels) {
        for (int i = 0; i < 3; ++i) edges[i] += right[i];
        across += pixels;
    }
    VIAFACE_INLINE void go_up() {
        for (int i = 0; i < 3; ++i) edges[i] += up[i];
        height += 1.0f;
    }
    VIAFACE_INLINE Eight nearness(const Triangle& t) const {
        return t.nearness_up * height + t.nearness + t.nearness_right * across;
    }
};

// Calls visit(walk, bounds) for blocks of the bounds; the walk stands at their lower left pixel.
template <class Visit>
VIAFACE_INLINE void for_blocks(const Scene& scene, std::uint32_t facet, const Bounds& bounds,
                               const Lanes& lanes, const Visit& visit) {
    if (bounds.bottom >= bounds.top) return;
    for (std::int32_t left = bounds.left; left < bounds.right; left += kBlock) {
        const Bounds block = {left, bounds.bottom, smaller(left + kBlock, bounds.right), bounds.top};
        visit(Walk(scene, facet, lanes, left, bounds.bottom), block);
    }
}

}  // namespace
}  // namespace viaface::raster::VIAFACE_KERNEL
