// What the shaders need of fragments: their nodes' values and their texels, kLanes fragments at a time. For
// raster_kernel.cpp alone.
#pragma once

#include "synth/picture/raster_blend.hpp"
#include "synth/picture/raster_scene.hpp"
#include "synth/picture/raster_threes.hpp"
#include "synth/picture/raster_turn.hpp"
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

VIAFACE_INLINE WideInt weights_across(Wide share) {
    const WideInt right = __builtin_convertvector(share * float(Quads::kAcross) + 0.5f, WideInt);
    const WideInt once = (Quads::kAcross - right) | right << 8;
    return once | once << 16;
}
VIAFACE_INLINE WideInt weights_down(Wide share) {
    const WideInt lower = __builtin_convertvector(share * float(Quads::kDown) + 0.5f, WideInt);
    return (Quads::kDown - lower) | lower << 16;
}

// Channel by channel, 0 to 1; bilinear, in steps of the weights; sideways the texture repeats.
VIAFACE_INLINE void fetch(const Level* const (&levels)[kLanes], Wide s, Wide t, Wide (&channels)[8]) {
    Four sizes[kLanes];
    for (int lane = 0; lane < kLanes; ++lane) sizes[lane] = load<Four>(&levels[lane]->columns);
    Wide size[4];  // columns, rows, stride
    turn(sizes, size);
    s = lesser(greater(s, wide(-1e6f)), wide(1e6f));
    const Wide column = (s - floor(s)) * size[0] + 0.5f;
    const Wide row = lesser(positive(t), wide(1.0f)) * size[1] + 0.5f;
    const Wide left = floor(column), upper = floor(row);
    const WideInt texel = __builtin_convertvector(left, WideInt),
                  line = __builtin_convertvector(upper, WideInt);
    Quads quads;
    quads.levels = levels;
    store(quads.offset, line * WideInt(size[2]) + texel * 8);
    store(quads.across, weights_across(column - left));
    store(quads.down, weights_down(row - upper));
    blend(quads, channels);
}

// Of kLanes facets.
struct Corners {
    const std::byte* nodes;
    std::uint32_t offsets[3][kLanes];  // bytes
    const Level* levels[kLanes];

    VIAFACE_INLINE Corners(const Scene& scene, const std::int32_t* facets)
        : nodes(reinterpret_cast<const std::byte*>(scene.nodes)) {
        Four rows[kLanes];
        for (int lane = 0; lane < kLanes; ++lane)
            rows[lane] = load<Four>(scene.facets[std::uint32_t(facets[lane])].node);
        Wide columns[4];
        turn(rows, columns);
        for (int i = 0; i < 3; ++i) store(offsets[i], WideInt(columns[i]) * std::int32_t(sizeof(Node)));
        std::uint32_t level[kLanes];
        store(level, WideInt(columns[3]) * std::int32_t(sizeof(Level)));
        asm volatile(""
                     : "+m"(offsets), "+m"(level));  // or compilers take them out of vectors, which is slower
        for (int lane = 0; lane < kLanes; ++lane)
            levels[lane] = reinterpret_cast<const Level*>(reinterpret_cast<const std::byte*>(scene.levels) +
                                                          level[lane]);
    }
    VIAFACE_INLINE const Node& node(int corner, int lane) const {
        return *reinterpret_cast<const Node*>(nodes + offsets[corner][lane]);
    }
};

// The corners' shares at the fragments' middles, corrected for perspective. Fragments beyond an edge, whose
// middle is not covered, take shares that end half a triangle from it.
VIAFACE_INLINE void share_out(const Corners& corners, WideInt x, WideInt y, Wide (&shares)[3]) {
    Wide right[3], up[3], nearness[3];
    for (int i = 0; i < 3; ++i) {
        Four rows[kLanes];
        for (int lane = 0; lane < kLanes; ++lane) rows[lane] = load<Four>(&corners.node(i, lane).place);
        Wide columns[4];
        turn(rows, columns);
        right[i] = __builtin_convertvector(WideInt(columns[0]) - (x * kSteps + kSteps / 2), Wide);
        up[i] = __builtin_convertvector(WideInt(columns[1]) - (y * kSteps + kSteps / 2), Wide);
        nearness[i] = columns[2];
    }
    Wide areas[3];
    for (int i = 0; i < 3; ++i) {
        const int a = (i + 1) % 3, b = (i + 2) % 3;
        areas[i] = right[a] * up[b] - right[b] * up[a];
    }
    const Wide per_area = 1.0f / (areas[0] + areas[1] + areas[2]);
    for (int i = 0; i < 3; ++i)
        shares[i] = lesser(greater(areas[i] * per_area, wide(-0.5f)), wide(2.0f)) * nearness[i];
    const Wide whole = 1.0f / greater(shares[0] + shares[1] + shares[2], wide(1e-9f));
    for (Wide& share : shares) share *= whole;
}

VIAFACE_INLINE Three way_to_camera(const Scene& scene, Wide x, Wide y) {
    const auto& eye = scene.to_camera;
    return unit({eye[0][0] + x * eye[1][0] + y * eye[2][0], eye[0][1] + x * eye[1][1] + y * eye[2][1],
                 eye[0][2] + x * eye[1][2] + y * eye[2][2]});
}

// The sum of the corners' numbers, each by its share: eight from Node::normal on, four from Node::s on.
VIAFACE_INLINE void sum_up(const Corners& corners, const Wide (&shares)[3], Wide (&from_normal)[8],
                           Wide (&from_s)[4]) {
    float shares_of[3][kLanes];
    for (int i = 0; i < 3; ++i) store(shares_of[i], shares[i]);
#if defined(__AVX512F__)
    static_assert(sizeof(Wide) == sizeof(Node));
    Wide values[kLanes];
    // Without the place: as floats its whole numbers are so small that they take long.
    const auto of = [&](int corner, int lane) __attribute__((always_inline)) {
        return Wide(_mm512_maskz_loadu_ps(0xfff0, &corners.node(corner, lane))) * shares_of[corner][lane];
    };
    for (int lane = 0; lane < kLanes; ++lane) values[lane] = of(0, lane) + of(1, lane) + of(2, lane);
    transpose(values);
    for (int i = 0; i < 8; ++i) from_normal[i] = values[4 + i];
    for (int i = 0; i < 4; ++i) from_s[i] = values[12 + i];
#else
    Eight rows[kLanes];
    Four last[kLanes];
    for (int lane = 0; lane < kLanes; ++lane) {
        const Node &a = corners.node(0, lane), &b = corners.node(1, lane), &c = corners.node(2, lane);
        const float u = shares_of[0][lane], v = shares_of[1][lane], w = shares_of[2][lane];
        rows[lane] = load<Eight>(a.normal) * u + load<Eight>(b.normal) * v + load<Eight>(c.normal) * w;
        last[lane] = load<Four>(&a.s) * u + load<Four>(&b.s) * v + load<Four>(&c.s) * w;
    }
    turn(rows, from_normal);
    turn(last, from_s);
#endif
}

// At the middles of the fragments' pixels.
VIAFACE_INLINE Lit light(const Scene& scene, const std::int32_t* facets, WideInt x, WideInt y) {
    const Corners corners(scene, facets);
    Wide shares[3];
    share_out(corners, x, y, shares);
    Wide from_normal[8], from_s[4];
    sum_up(corners, shares, from_normal, from_s);
    Wide texel[8];
    fetch(corners.levels, from_s[0], from_s[1], texel);
    return {{from_normal[0], from_normal[1], from_normal[2]},
            {from_normal[3], from_normal[4], from_normal[5]},
            way_to_camera(scene, __builtin_convertvector(x, Wide), __builtin_convertvector(y, Wide)),
            from_s[2],
            from_normal[6],
            from_normal[7],
            {texel[0], texel[1], texel[2]},
            texel[3],
            texel[4],
            texel[5],
            texel[6],
            texel[7]};
}

}  // namespace
}  // namespace viaface::raster::VIAFACE_KERNEL
