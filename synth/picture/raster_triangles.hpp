// Triangles on the grid of corners: exact edges, the linear functions over them, and a walk over the samples
// that they cover. For raster_kernel.cpp alone.
#pragma once

#include "synth/picture/raster_scene.hpp"
#include "synth/picture/raster_wide.hpp"

namespace viaface::raster::VIAFACE_KERNEL {
namespace {

constexpr std::int64_t kEighth = kSteps / 8;
constexpr int kBlock = 16;  // pixels: edge functions stay within 32 bits

// Places of the lanes of a vector, in eighths of a pixel from the first pixel's middle.
struct Lanes {
    WideInt right, up;
    WideInt pixel;  // after the first
    std::int32_t pixels;
};
constexpr Lanes kMiddles = {{0, 8, 16, 24, 32, 40, 48, 56}, {}, {0, 1, 2, 3, 4, 5, 6, 7}, 8};
constexpr Lanes kTwoPixels = {
    {-1, 3, -3, 1, 7, 11, 5, 9}, {-3, -1, 1, 3, -3, -1, 1, 3}, {0, 0, 0, 0, 1, 1, 1, 1}, 2};

// Positive on the left of the way from `a` to `b`, on the grid.
struct Edge {
    std::int64_t right, up, start;

    VIAFACE_INLINE Edge(const Place& a, const Place& b)
        : right(std::int64_t(a.y) - b.y), up(std::int64_t(b.x) - a.x), start(-right * a.x - up * a.y) {}
    VIAFACE_INLINE std::int64_t at(std::int64_t x, std::int64_t y) const {
        return start + right * x + up * y;
    }
    // A sample on the edge belongs to the triangle on one side alone.
    VIAFACE_INLINE bool owns() const { return right > 0 || (right == 0 && up < 0); }
};

VIAFACE_INLINE std::int64_t middle(std::int64_t pixel) { return pixel * kSteps + kSteps / 2; }

struct Prepared {
    Edge edges[3];  // opposite the corners
    Bounds bounds;
    bool drawn;
};

// The level whose texels are nearest to a pixel in size, along the axis where they are most.
VIAFACE_INLINE const Level* level_of(const Mipmap& mipmap, const Node* const (&n)[3], const Edge (&edges)[3],
                                     float area) {
    const float width = mipmap.levels[0].columns, height = mipmap.levels[0].rows;
    float right_s = 0, right_t = 0, up_s = 0, up_t = 0;
    for (int i = 0; i < 3; ++i) {
        const float right = float(edges[i].right), up = float(edges[i].up);
        right_s += right * n[i]->s, right_t += right * n[i]->t;
        up_s += up * n[i]->s, up_t += up * n[i]->t;
    }
    right_s *= width, up_s *= width, right_t *= height, up_t *= height;
    const float most = larger(right_s * right_s + right_t * right_t, up_s * up_s + up_t * up_t);
    const float share = float(kSteps) / area;
    const float texels = most * share * share;  // per pixel, squared
    int level = 0;
    for (float limit = 2; level + 1 < mipmap.count && texels > limit; limit *= 4) ++level;
    return &mipmap.levels[level];
}

VIAFACE_INLINE Prepared prepare(const Scene& scene, const Bounds& seen, const Facet& facet, Surface& s) {
    std::int32_t n0 = facet.node[0], n1 = facet.node[1], n2 = facet.node[2];
    const Edge side(scene.places[n0], scene.places[n1]);
    std::int64_t area = side.at(scene.places[n2].x, scene.places[n2].y);
    if (area < 0 && facet.two_sided) {
        const std::int32_t swapped = n1;
        n1 = n2, n2 = swapped, area = -area;
    }
    const Place &a = scene.places[n0], &b = scene.places[n1], &c = scene.places[n2];
    Prepared p{{Edge(b, c), Edge(c, a), Edge(a, b)}, common(box_of(a, b, c), seen), false};
    if (area <= 0 || p.bounds.left >= p.bounds.right || p.bounds.bottom >= p.bounds.top) return p;
    p.drawn = true;
    const Place* places[3] = {&a, &b, &c};
    const std::int32_t x = floor_pixel(a.x), y = floor_pixel(a.y);
    const float twice_area = float(area);
    s.x = float(x), s.y = float(y);
    s.nearness = s.nearness_right = s.nearness_up = 0;
    for (int i = 0; i < 3; ++i) {
        const float near = places[i]->nearness;
        s.weight[i] = float(p.edges[i].at(middle(x), middle(y))) * near;
        s.weight_right[i] = float(p.edges[i].right * kSteps) * near;
        s.weight_up[i] = float(p.edges[i].up * kSteps) * near;
        s.least[i] = -0.5f * twice_area * near;
        s.nearness += s.weight[i], s.nearness_right += s.weight_right[i], s.nearness_up += s.weight_up[i];
    }
    s.weight[3] = s.weight_right[3] = s.weight_up[3] = s.least[3] = 0;
    s.nearness /= twice_area, s.nearness_right /= twice_area, s.nearness_up /= twice_area;
    s.node[0] = n0, s.node[1] = n1, s.node[2] = n2;
    const Node* const nodes[3] = {scene.nodes + n0, scene.nodes + n1, scene.nodes + n2};
    s.side = nodes[0]->side;
    s.level = level_of(scene.mipmaps[facet.material], nodes, p.edges, twice_area);
    s.material_number = float(facet.material);
    s.shade = facet.shade;
    return p;
}

// An edge function at the lanes' places, in steps of an eighth of a pixel: its sign is that of the exact
// function.
struct BlockEdge {
    WideInt at, right, up;

    VIAFACE_INLINE BlockEdge(const Edge& edge, const Lanes& lanes, std::int64_t x, std::int64_t y) {
        const std::int64_t exact = (edge.at(middle(x), middle(y)) - !edge.owns()) >> 4;
        constexpr std::int64_t kFar = 1 << 30;
        const auto first = std::int32_t(smaller(larger(exact, -kFar), kFar));
        const auto to_right = std::int32_t(edge.right), to_up = std::int32_t(edge.up);
        at = wide(first) + lanes.right * to_right + lanes.up * to_up;
        right = wide(8 * lanes.pixels * to_right);
        up = wide(8 * to_up);
    }
};
static_assert(kEighth == 1 << 4);

struct AllPixels {
    VIAFACE_INLINE std::uint32_t operator()(std::int32_t, std::int32_t) const { return ~0u; }
};

// Calls visit(x, y, outside, nearness) for vectors of pixels that hold a place within the triangle; `outside`
// is below zero in the lanes of other places. Pixels without a bit in wanted(x, y), the first of which
// stands for pixel x, may be passed over.
template <class Wanted, class Visit>
VIAFACE_INLINE void for_pixels(const Prepared& p, const Surface& s, const Lanes& lanes, const Wanted& wanted,
                               const Visit& visit) {
    const Wide lane_right = __builtin_convertvector(lanes.right, Wide) * 0.125f - s.x;
    const Wide lane_up = __builtin_convertvector(lanes.up, Wide) * 0.125f - s.y;
    const Wide slope = wide(s.nearness_right);
    const std::uint32_t these = (1u << lanes.pixels) - 1;
    for (std::int32_t block = p.bounds.left; block < p.bounds.right; block += kBlock) {
        const std::int32_t end = smaller(block + kBlock, p.bounds.right);
        BlockEdge e0(p.edges[0], lanes, block, p.bounds.bottom),
            e1(p.edges[1], lanes, block, p.bounds.bottom), e2(p.edges[2], lanes, block, p.bounds.bottom);
        const Wide first_right = lane_right + float(block);
        const WideInt first_room = end - 1 - block - lanes.pixel;
        for (std::int32_t y = p.bounds.bottom; y < p.bounds.top; ++y) {
            std::uint32_t left = wanted(block, y);
            WideInt a = e0.at, b = e1.at, c = e2.at, room = first_room;
            Wide right = first_right;
            const Wide row = s.nearness_up * (lane_up + float(y)) + s.nearness;
            for (std::int32_t x = block; x < end && left != 0; x += lanes.pixels) {
                const WideInt outside = a | b | c | room;
                if ((left & these) != 0 && negative_lanes(outside) != 0xff)
                    visit(x, y, outside, row + slope * right);
                a += e0.right, b += e1.right, c += e2.right;
                room -= lanes.pixels, right += float(lanes.pixels);
                left >>= lanes.pixels;
            }
            e0.at += e0.up, e1.at += e1.up, e2.at += e2.up;
        }
    }
}

}  // namespace
}  // namespace viaface::raster::VIAFACE_KERNEL
