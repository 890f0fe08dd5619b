// What the rasteriser's kernels read and write: plain arrays, as the kernels are compiled once per
// instruction set and may share no inline function with the rest of the program but those that are always
// inlined.
//
// Where they have moved, posed vertices are placed as nodes and facets set up as triangles of the picture,
// several at a time. Then stripes of rows are drawn, each in three steps. Triangles first settle what is in
// front (a visibility buffer: C. A. Burns and W. A. Hunt, "The visibility buffer: a cache-friendly approach
// to deferred shading", JCGT 2(2), 2013): in the middle of each pixel, and at four samples of the fine
// pixels, in which more than one surface may be seen (FinePixels). Then each pixel is shaded once for every
// surface that it sees, eight or sixteen fragments at a time, but for pixels that hold one triangle alone,
// now and before, which has not moved: they keep their colour. Of fine pixels, triangles that continue each
// other count as one surface, so that edges are as smooth as with multisampling. Last come the lashes,
// blended in their order. Departures: no clipping; a triangle with a corner outside kGuard or behind the
// camera is not drawn.
#pragma once

#include <cstddef>
#include <cstdint>

namespace viaface::raster {

inline constexpr int kStripeRows = 16;
inline constexpr int kSamples = 4;
inline constexpr int kSteps = 128;   // per pixel: the grid on which corners lie, so that edges are exact
inline constexpr int kGuard = 8192;  // pixels from the middle of the picture, either way
inline constexpr int kLevels = 13;
inline constexpr int kMostFineWords = 65;  // of a row: 4096 pixels, and one that is over
inline constexpr int kFacetsAtOnce = 16;   // the most that a kernel sets up together
inline constexpr int kPixelsBeyond = 7;    // the last of eight pixels at a time may lie outside the picture

struct Place {
    std::int32_t x, y;  // 1/kSteps pixel from the lower left corner
    float nearness;     // 1 / distance along the view, 1/mm; 0 where it cannot be drawn
    float unused = 0;
};

struct alignas(64) Node {
    Place place;
    float normal[3];   // unit, world
    float tangent[3];  // across the normal, world
    float light, key;  // shares of the outside light and of the key light that get here
    float s, t;        // of the texture, from its upper left corner
    float side;        // bitangent = side * normal x tangent
    float unused;
};

// From posed vertices to nodes.
struct Placing {
    const float* vertices;     // [nodes x 8]: place, mm, and unit normal in the head frame, light, key
    const float* tangents;     // [nodes x 4]: at rest, unit, head frame, and one that is over
    const std::uint8_t* lash;  // of each node: 1 where it is a lash's, which is drawn before what it lies on
    Node* nodes;               // s, t and side stay as they are
    float world_from_head[3][4], clip_from_world[4][4], eye[3];
    float half_width, half_height;  // of the picture, pixels
    float far;                      // 1 / distance of the camera, 1/mm
    float lashes_before;            // mm
    bool orthographic;
};

// Texels of 8 bytes: base R G B A, detail R G B A. A border of one texel goes round: sideways the texture
// repeats, up and down its edge does.
struct Level {
    float columns, rows;         // without the border
    std::uint32_t stride;        // bytes from a row to the next
    const std::uint8_t* border;  // [(height + 2) x (width + 2) x 8], within 2^32 bytes
};

enum class Shade : std::uint8_t { kSkin, kInside, kEye, kCloth, kLash };
inline constexpr int kOpaqueShades = 4;

struct Facet {
    std::int32_t node[3];
    std::int32_t level;  // of all materials' textures; set up with its triangle
    std::uint8_t material;
    Shade shade;
    bool inside;  // seen through the opening alone
    bool two_sided;
    bool fine;  // in fine pixels alone
};

// Ways over a facet's finest texture from its first corner to the others, texels.
struct TexelWays {
    float s1, t1, s2, t2;
};

struct Bounds {
    std::int32_t left, bottom, right, top;  // pixels; right and top are outside
};

// A facet in the picture. Its functions of the place begin at the middle of its box's lower left pixel.
struct alignas(64) Triangle {
    // Edge functions, opposite each corner: not below zero where a place belongs to the triangle.
    std::int32_t first[3];  // in steps of an eighth of a pixel; of small triangles alone
    std::int32_t small;     // a box of kSmall pixels at most, either way: all is exact in 32 bits
    std::int32_t right[3];  // per step of the grid
    std::int32_t unused_1;
    std::int32_t up[3];  // per step of the grid
    std::int32_t unused_2;
    float nearness, nearness_right, nearness_up, material;
};
inline constexpr int kSmall = 128;

#define VIAFACE_INLINE inline __attribute__((always_inline))

template <class T>
VIAFACE_INLINE T smaller(T a, T b) {
    return a < b ? a : b;
}
template <class T>
VIAFACE_INLINE T larger(T a, T b) {
    return a > b ? a : b;
}

VIAFACE_INLINE std::int32_t floor_pixel(std::int32_t place) { return place >> 7; }
static_assert(1 << 7 == kSteps);

VIAFACE_INLINE Bounds common(const Bounds& a, const Bounds& b) {
    return {larger(a.left, b.left), larger(a.bottom, b.bottom), smaller(a.right, b.right),
            smaller(a.top, b.top)};
}

// Of each facet.
struct Triangles {
    Triangle* triangles;
    Bounds* boxes;       // pixels in which it may have samples
    std::uint8_t* seen;  // 1 where it may be seen: in reach of the camera, and turned towards it or two-sided
};

struct Scene {
    const Node* nodes;
    Facet* facets;  // a multiple of kFacetsAtOnce
    const TexelWays* texel_ways;
    Triangles triangles;
    const Level* levels;  // [materials x kLevels], the coarsest repeated
    const std::uint32_t* background;
    std::uint32_t* rgba;
    std::uint32_t* alone;       // of each pixel: 1 + the facet that is all there was when it was drawn, or 0
    const std::uint8_t* still;  // of each facet: 1 where it is as it was when the picture was drawn
    const std::uint64_t* fine;  // [height x fine_words], a bit for each pixel
    std::int64_t fine_words;    // of a row, the last of which is over
    std::int32_t width;         // of the picture, pixels
    float to_camera[3][3];      // world: at pixel (0, 0), per pixel to the right, per pixel up; any length
    float fold, step;           // surfaces part where slopes differ by `fold` or heights by `step`, both as a
                                // share of the distance, per pixel
    Bounds opening;
};

struct Stripe {
    Bounds bounds;
    const std::uint32_t* facets;  // in drawing order, lashes last
    std::int32_t count;
};

// What is in front: of each place its nearness, and 1 + the facet, with the highest bit set where it is not
// still, or 0 for the background.
struct Front {
    float* nearness;
    std::int32_t* seen;
};

// For one thread.
struct Scratch {
    Front middles;        // [kStripeRows x (width + kPixelsBeyond)]
    Front samples;        // [kStripeRows x (width + 1) x kSamples], of fine pixels
    std::uint32_t* sums;  // [kStripeRows x width], 10 bits each for red, green, blue
    std::int32_t* mixed;  // [kStripeRows x width], pixels of the picture
};

struct Kernel {
    // The nodes that are listed.
    void (*place)(const Placing& placing, const std::int32_t* nodes, int count);
    // Of the facets from `first` to `end`, multiples of kFacetsAtOnce, those that are not still, and some
    // more.
    void (*set_up)(const Scene& scene, int first, int end);
    void (*draw)(const Scene& scene, const Stripe& stripe, const Scratch& scratch);
};

namespace baseline {
extern const Kernel kKernel;
}
namespace avx2 {
extern const Kernel kKernel;
}
namespace avx512 {
extern const Kernel kKernel;
}

}  // namespace viaface::raster
