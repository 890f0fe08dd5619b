// What the shaders need of fragments: their nodes' values and their texels, eight fragments at a time. For
// raster_kernel.cpp alone.
#pragma once

#include "synth/picture/raster_scene.hpp"
#include "synth/picture/raster_wide.hpp"

namespace viaface::raster::VIAFACE_KERNEL {
namespace {

struct Lit {
    Three normal, tangent, to_camera;  // to_camera is unit
    Wide side, light, key;
    Three base;  // sRGB
    Wide cover;  // occlusion, or the lashes' cover
    Wide slope_x, slope_y, roughness, thinness;
};

// Channel by channel, 0 to 1; bilinear; sideways the texture repeats.
VIAFACE_INLINE void fetch(const Level* const (&levels)[8], Wide s, Wide t, Wide (&channels)[8]) {
    Wide width, height;
    for (int lane = 0; lane < 8; ++lane) {
        width[lane] = levels[lane]->columns;
        height[lane] = levels[lane]->rows;
    }
    s = lesser(greater(s, wide(-1e6f)), wide(1e6f));
    const Wide column = (s - floor(s)) * width + 0.5f;
    const Wide row = lesser(positive(t), wide(1.0f)) * height + 0.5f;
    const Wide left = floor(column), upper = floor(row);
    const Wide column_share = column - left, row_share = row - upper;
    const WideInt texel = __builtin_convertvector(left, WideInt),
                  line = __builtin_convertvector(upper, WideInt);
    for (int lane = 0; lane < 8; ++lane) {
        const std::ptrdiff_t stride = levels[lane]->stride;
        const std::uint8_t* const at =
            levels[lane]->border + line[lane] * stride + std::ptrdiff_t(texel[lane]) * 8;
        const Wide a = from_bytes(at), b = from_bytes(at + 8), c = from_bytes(at + stride),
                   d = from_bytes(at + stride + 8);
        const Wide high = a + (b - a) * column_share[lane], low = c + (d - c) * column_share[lane];
        channels[lane] = high + (low - high) * row_share[lane];
    }
    transpose(channels);
    for (int i = 0; i < 8; ++i) channels[i] *= 1.0f / 255;
}

// The corners' shares at each fragment's middle, corrected for perspective.
VIAFACE_INLINE void share_out(const Surface* const (&surfaces)[8], Wide x, Wide y, float (&shares)[3][8]) {
    Wide weights[8];
    for (int lane = 0; lane < 8; ++lane) {
        const Surface& s = *surfaces[lane];
        const Four weight = load<Four>(s.weight) + load<Four>(s.weight_right) * (x[lane] - s.x) +
                            load<Four>(s.weight_up) * (y[lane] - s.y);
        store(&weights[lane], greater(weight, load<Four>(s.least)));
    }
    transpose(weights);
    const Wide whole = 1.0f / (weights[0] + weights[1] + weights[2]);
    for (int i = 0; i < 3; ++i) store(shares[i], weights[i] * whole);
}

VIAFACE_INLINE Three way_to_camera(const Scene& scene, Wide x, Wide y) {
    const auto& eye = scene.to_camera;
    return unit({eye[0][0] + x * eye[1][0] + y * eye[2][0], eye[0][1] + x * eye[1][1] + y * eye[2][1],
                 eye[0][2] + x * eye[1][2] + y * eye[2][2]});
}

// At the middles of the fragments' pixels.
VIAFACE_INLINE Lit light(const Scene& scene, const Surface* all, const Fragment* fragments) {
    const Surface* surfaces[8];
    const Level* levels[8];
    Wide x, y, side;
    for (int lane = 0; lane < 8; ++lane) {
        const Fragment& f = fragments[lane];
        surfaces[lane] = all + f.surface;
        levels[lane] = surfaces[lane]->level;
        x[lane] = float(f.x), y[lane] = float(f.y);
        side[lane] = surfaces[lane]->side;
    }
    float shares[3][8];
    share_out(surfaces, x, y, shares);
    Wide places[8];
    Four lights[2][4];
    for (int lane = 0; lane < 8; ++lane) {
        const auto& [n0, n1, n2] = surfaces[lane]->node;
        const Node &a = scene.nodes[n0], &b = scene.nodes[n1], &c = scene.nodes[n2];
        const float u = shares[0][lane], v = shares[1][lane], w = shares[2][lane];
        places[lane] = load<Wide>(a.normal) * u + load<Wide>(b.normal) * v + load<Wide>(c.normal) * w;
        lights[lane / 4][lane % 4] =
            load<Four>(&a.light) * u + load<Four>(&b.light) * v + load<Four>(&c.light) * w;
    }
    transpose(places);
    transpose(lights[0]), transpose(lights[1]);
    Wide texels[8];
    fetch(levels, places[6], places[7], texels);
    return {{places[0], places[1], places[2]},
            {places[3], places[4], places[5]},
            way_to_camera(scene, x, y),
            side,
            joined(lights[0][0], lights[1][0]),
            joined(lights[0][1], lights[1][1]),
            {texels[0], texels[1], texels[2]},
            texels[3],
            texels[4],
            texels[5],
            texels[6],
            texels[7]};
}

}  // namespace
}  // namespace viaface::raster::VIAFACE_KERNEL
