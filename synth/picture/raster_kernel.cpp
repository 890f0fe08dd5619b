// Compiled once per instruction set, which VIAFACE_KERNEL names.
#include "synth/picture/raster_scene.hpp"
#include "synth/picture/raster_shades.hpp"
#include "synth/picture/raster_wide.hpp"

namespace viaface::raster::VIAFACE_KERNEL {
namespace {

constexpr std::int64_t kEighth = kSteps / 8;
constexpr int kBlock = 16;  // pixels: edge functions stay within 32 bits

// Two pixels' samples fill a vector: places from the first pixel's middle, in eighths of a pixel.
constexpr WideInt kRightEighths = {-1, 3, -3, 1, 7, 11, 5, 9};
constexpr WideInt kUpEighths = {-3, -1, 1, 3, -3, -1, 1, 3};
constexpr Four kSampleRight = {-0.125f, 0.375f, -0.375f, 0.125f};
constexpr Four kSampleUp = {-0.375f, -0.125f, 0.125f, 0.375f};

VIAFACE_INLINE Four magnitude(Four v) { return greater(v, -v); }

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

// An edge function at the samples of two pixels of a block, in steps of an eighth of a pixel: its sign is
// that of the exact function.
struct BlockEdge {
    WideInt at, right, up;

    VIAFACE_INLINE BlockEdge(const Edge& edge, std::int64_t x, std::int64_t y) {
        const std::int64_t exact = (edge.at(middle(x), middle(y)) - !edge.owns()) >> 4;
        constexpr std::int64_t kFar = 1 << 30;
        const auto first = std::int32_t(smaller(larger(exact, -kFar), kFar));
        const auto to_right = std::int32_t(edge.right), to_up = std::int32_t(edge.up);
        at = wide(first) + kRightEighths * to_right + kUpEighths * to_up;
        right = wide(16 * to_right);
        up = wide(8 * to_up);
    }
};
static_assert(kEighth == 1 << 4);

// Calls visit(x, y, outside, nearness) for pairs of pixels that hold a sample within the triangle; `outside`
// is below zero in the lanes of other samples.
template <class Visit>
VIAFACE_INLINE void for_pairs(const Prepared& p, const Surface& s, const Visit& visit) {
    constexpr WideInt kPixel = {0, 0, 0, 0, 1, 1, 1, 1};
    const Wide sample_right = __builtin_convertvector(kRightEighths, Wide) * 0.125f - s.x;
    const Wide sample_up = __builtin_convertvector(kUpEighths, Wide) * 0.125f - s.y;
    const Wide slope = wide(s.nearness_right);
    for (std::int32_t block = p.bounds.left; block < p.bounds.right; block += kBlock) {
        const std::int32_t end = smaller(block + kBlock, p.bounds.right);
        BlockEdge e0(p.edges[0], block, p.bounds.bottom), e1(p.edges[1], block, p.bounds.bottom),
            e2(p.edges[2], block, p.bounds.bottom);
        const Wide first_right = sample_right + float(block);
        const WideInt first_room = end - 1 - block - kPixel;
        for (std::int32_t y = p.bounds.bottom; y < p.bounds.top; ++y) {
            WideInt a = e0.at, b = e1.at, c = e2.at, room = first_room;
            Wide right = first_right;
            const Wide row = s.nearness_up * (sample_up + float(y)) + s.nearness;
            for (std::int32_t x = block; x < end; x += 2) {
                const WideInt outside = a | b | c | room;
                if (negative_lanes(outside) != 0xff) visit(x, y, outside, row + slope * right);
                a += e0.right, b += e1.right, c += e2.right;
                room -= 2, right += 2.0f;
            }
            e0.at += e0.up, e1.at += e1.up, e2.at += e2.up;
        }
    }
}

class StripeDrawing {
  public:
    VIAFACE_INLINE StripeDrawing(const Scene& scene, const Stripe& stripe, const Scratch& scratch)
        : scene_(scene), stripe_(stripe), scratch_(scratch), bounds_(stripe.bounds) {}

    VIAFACE_INLINE void draw() {
        clear();
        const std::int32_t lashes = settle();
        resolve();
        blend(lashes);
    }

  private:
    static constexpr int kQueued = 8;
    struct Queue {
        Fragment fragments[kQueued];
        int count = 0;
    };

    VIAFACE_INLINE std::int32_t sample(std::int32_t x, std::int32_t y) const {
        return ((y - bounds_.bottom) * (scene_.width + 1) + x - bounds_.left) * kSamples;
    }
    VIAFACE_INLINE std::int32_t pixel(std::int32_t x, std::int32_t y) const {
        return (y - bounds_.bottom) * scene_.width + x - bounds_.left;
    }
    VIAFACE_INLINE std::uint32_t& rgba(std::int32_t x, std::int32_t y) const {
        return scene_.rgba[std::int64_t(y) * scene_.width + x];
    }
    VIAFACE_INLINE std::uint32_t background(std::int32_t x, std::int32_t y) const {
        return scene_.background[std::int64_t(y) * scene_.width + x];
    }

    VIAFACE_INLINE void clear() {
        const std::size_t width = std::size_t(bounds_.right - bounds_.left);
        for (std::int32_t y = bounds_.bottom; y < bounds_.top; ++y) {
            __builtin_memset(scratch_.nearness + sample(bounds_.left, y), 0, (width + 1) * kSamples * 4);
            __builtin_memset(scratch_.seen + sample(bounds_.left, y), 0, (width + 1) * kSamples * 4);
            __builtin_memcpy(&rgba(bounds_.left, y),
                             scene_.background + std::int64_t(y) * scene_.width + bounds_.left, width * 4);
        }
    }

    Prepared prepare(std::int32_t i) {
        const Facet& facet = scene_.facets[stripe_.facets[i]];
        return VIAFACE_KERNEL::prepare(scene_, facet.inside ? common(bounds_, scene_.opening) : bounds_,
                                       facet, scratch_.surfaces[i]);
    }

    // What is in front. The first of the lashes.
    std::int32_t settle() {
        const std::ptrdiff_t origin = sample(0, 0), row = std::ptrdiff_t(scene_.width + 1) * kSamples;
        float* const near = scratch_.nearness;
        std::int32_t* const seen = scratch_.seen;
        for (std::int32_t i = 0; i < stripe_.count; ++i) {
            if (scene_.facets[stripe_.facets[i]].shade == Shade::kLash) return i;
            const Prepared p = prepare(i);
            if (!p.drawn) continue;
            const WideInt id = wide(i + 1);
            const auto keep_nearer = [=](std::int32_t x, std::int32_t y, WideInt outside, Wide nearness)
                __attribute__((always_inline)) {
                const std::ptrdiff_t at = origin + y * row + std::ptrdiff_t(x) * kSamples;
                const auto before = load<Wide>(near + at);
                const WideInt in_front = (outside >= 0) & (nearness > before);
                store(near + at, in_front ? nearness : before);
                store(seen + at, in_front ? id : load<WideInt>(seen + at));
            };
            for_pairs(p, scratch_.surfaces[i], keep_nearer);
        }
        return stripe_.count;
    }

    void resolve() {
        mixed_ = 0;
        for (std::int32_t y = bounds_.bottom; y < bounds_.top; ++y) {
            const std::int32_t* seen = scratch_.seen + sample(bounds_.left, y);
            for (std::int32_t x = bounds_.left; x < bounds_.right; ++x, seen += kSamples) {
                if ((seen[0] ^ seen[1]) | (seen[0] ^ seen[2]) | (seen[0] ^ seen[3])) {
                    resolve_mixed(x, y, seen);
                } else if (seen[0] != 0) {
                    push({x, y, seen[0] - 1, kSamples});
                }
            }
        }
        flush<Shade::kSkin>();
        flush<Shade::kInside>();
        flush<Shade::kEye>();
        flush<Shade::kCloth>();
        for (std::int32_t i = 0; i < mixed_; ++i) {
            const auto& [x, y, surface, samples] = scratch_.mixed[i];
            const std::uint32_t sum = scratch_.sums[pixel(x, y)] + 2 * kOne;
            rgba(x, y) = (sum >> 2 & 255) | (sum >> 12 & 255) << 8 | (sum >> 22 & 255) << 16 | kOpaque;
        }
    }

    static constexpr std::uint32_t kOne = 1 | 1 << 10 | 1 << 20, kOpaque = 255u << 24;

    static VIAFACE_INLINE std::uint32_t spread(std::uint32_t rgba) {
        return (rgba & 255) | (rgba >> 8 & 255) << 10 | (rgba >> 16 & 255) << 20;
    }

    // Shares a pixel's samples out among surfaces that do not go on in each other: another material, a fold
    // or a step is between them.
    __attribute__((noinline)) void resolve_mixed(std::int32_t x, std::int32_t y,
                                                 const std::int32_t* samples) {
        const auto seen = load<FourInt>(samples);
        const auto near = load<Four>(scratch_.nearness + (samples - scratch_.seen));
        Four planes[kSamples];
        for (int i = 0; i < kSamples; ++i) planes[i] = load<Four>(plane_of(larger(samples[i], 1)));
        transpose(planes);
        const Four reach = scene_.step * near, fold = scene_.fold * near;
        unsigned left = negative_lanes(seen > 0);
        std::uint32_t& sum = scratch_.sums[pixel(x, y)];
        sum = std::uint32_t(kSamples - __builtin_popcount(left)) * spread(background(x, y));
        for (bool first = true; left != 0; first = false) {
            const std::int32_t id = samples[__builtin_ctz(left)];
            const Surface& s = scratch_.surfaces[id - 1];
            const Four gap = s.nearness + (kSampleRight + (float(x) - s.x)) * s.nearness_right +
                             (kSampleUp + (float(y) - s.y)) * s.nearness_up - near;
            const Four turn = magnitude(planes[1] - s.nearness_right) + magnitude(planes[2] - s.nearness_up);
            const FourInt goes_on =
                (magnitude(gap) < reach) & (turn < fold) & (planes[3] == s.material_number);
            const unsigned one = negative_lanes(goes_on | (seen == id)) & left;
            const std::int32_t count = __builtin_popcount(one);
            left &= ~one;
            if (first && count < kSamples) scratch_.mixed[mixed_++] = {x, y, 0, 0};
            push({x, y, id - 1, count});
        }
    }

    VIAFACE_INLINE const float* plane_of(std::int32_t id) const {
        return &scratch_.surfaces[id - 1].nearness;
    }

    VIAFACE_INLINE void push(const Fragment& fragment) {
        const Shade shade = scratch_.surfaces[fragment.surface].shade;
        Queue& queue = queues_[int(shade)];
        queue.fragments[queue.count++] = fragment;
        if (queue.count < kQueued) return;
        switch (shade) {
            case Shade::kSkin:
                return flush<Shade::kSkin>();
            case Shade::kInside:
                return flush<Shade::kInside>();
            case Shade::kEye:
                return flush<Shade::kEye>();
            case Shade::kCloth:
                return flush<Shade::kCloth>();
            case Shade::kLash:
                return flush<Shade::kLash>();
        }
    }

    template <Shade shade>
    __attribute__((noinline)) void flush() {
        Queue& queue = queues_[int(shade)];
        if (queue.count == 0) return;
        for (int i = queue.count; i < kQueued; ++i) queue.fragments[i] = queue.fragments[0];
        const Lit lit = light(queue.fragments);
        const Three c = shaded<shade>(lit);
        const WideInt colour = byte(filmic(c.x)) | byte(filmic(c.y)) << 8 | byte(filmic(c.z)) << 16;
        std::uint32_t colours[kQueued];
        store(colours, colour);
        if constexpr (shade == Shade::kLash) {
            float covers[kQueued];
            store(covers, lit.cover);
            for (int i = 0; i < queue.count; ++i) lay_over(queue.fragments[i], colours[i], covers[i]);
        } else {
            for (int i = 0; i < queue.count; ++i) add(queue.fragments[i], colours[i]);
        }
        queue.count = 0;
    }

    VIAFACE_INLINE void add(const Fragment& f, std::uint32_t colour) {
        if (f.samples == kSamples) {
            rgba(f.x, f.y) = colour | kOpaque;
        } else {
            scratch_.sums[pixel(f.x, f.y)] += std::uint32_t(f.samples) * spread(colour);
        }
    }

    VIAFACE_INLINE void lay_over(const Fragment& f, std::uint32_t colour, float cover) {
        std::uint32_t& to = rgba(f.x, f.y);
        const float share = cover * float(f.samples) * (1.0f / kSamples);
        std::uint32_t mixed = kOpaque;
        for (int shift = 0; shift < 24; shift += 8) {
            const float under = float(to >> shift & 255), over = float(colour >> shift & 255);
            mixed |= std::uint32_t(under + share * (over - under) + 0.5f) << shift;
        }
        to = mixed;
    }

    // What the shaders need of each fragment, at its pixel's middle.
    VIAFACE_INLINE Lit light(const Fragment* fragments) const {
        const Surface* surfaces[8];
        const Level* levels[8];
        Wide weights[8], right, up, side;
        for (int lane = 0; lane < 8; ++lane) {
            const Fragment& f = fragments[lane];
            const Surface& s = scratch_.surfaces[f.surface];
            right[lane] = float(f.x), up[lane] = float(f.y);
            const Four weight = load<Four>(s.weight) + load<Four>(s.weight_right) * (float(f.x) - s.x) +
                                load<Four>(s.weight_up) * (float(f.y) - s.y);
            store(&weights[lane], greater(weight, load<Four>(s.least)));
            side[lane] = s.side;
            surfaces[lane] = &s;
            levels[lane] = s.level;
        }
        transpose(weights);
        const Wide whole = 1.0f / (weights[0] + weights[1] + weights[2]);
        float shares[3][8];
        for (int i = 0; i < 3; ++i) store(shares[i], weights[i] * whole);
        Wide places[8], lights[3];
        for (int lane = 0; lane < 8; ++lane) {
            const auto& [n0, n1, n2] = surfaces[lane]->node;
            const Node &a = scene_.nodes[n0], &b = scene_.nodes[n1], &c = scene_.nodes[n2];
            places[lane] = load<Wide>(a.normal) * shares[0][lane] + load<Wide>(b.normal) * shares[1][lane] +
                           load<Wide>(c.normal) * shares[2][lane];
            lights[0][lane] = a.light, lights[1][lane] = b.light, lights[2][lane] = c.light;
        }
        const Wide lit = lights[0] * load<Wide>(shares[0]) + lights[1] * load<Wide>(shares[1]) +
                         lights[2] * load<Wide>(shares[2]);
        transpose(places);
        Wide texels[8];
        fetch(levels, places[6], places[7], texels);
        const auto& eye = scene_.to_camera;
        const Three to_camera = unit({eye[0][0] + right * eye[1][0] + up * eye[2][0],
                                      eye[0][1] + right * eye[1][1] + up * eye[2][1],
                                      eye[0][2] + right * eye[1][2] + up * eye[2][2]});
        return {{places[0], places[1], places[2]},
                {places[3], places[4], places[5]},
                to_camera,
                side,
                lit,
                {texels[0], texels[1], texels[2]},
                texels[3],
                texels[4],
                texels[5],
                texels[6],
                texels[7]};
    }

    // Channel by channel, 0 to 1; bilinear; sideways the texture repeats.
    static VIAFACE_INLINE void fetch(const Level* const (&levels)[8], Wide s, Wide t, Wide (&channels)[8]) {
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

    void blend(std::int32_t first) {
        for (std::int32_t i = first; i < stripe_.count; ++i) {
            const Prepared p = prepare(i);
            if (!p.drawn) continue;
            for_pairs(
                p, scratch_.surfaces[i],
                [&](std::int32_t x, std::int32_t y, WideInt outside,
                    Wide nearness) __attribute__((always_inline)) {
                    const Wide before = load<Wide>(scratch_.nearness + sample(x, y));
                    const unsigned lanes = negative_lanes((outside >= 0) & (nearness > before));
                    const int here = __builtin_popcount(lanes & 15), next = __builtin_popcount(lanes >> 4);
                    if (here != 0) push({x, y, i, here});
                    if (next != 0) push({x + 1, y, i, next});
                });
        }
        flush<Shade::kLash>();
    }

    const Scene& scene_;
    const Stripe& stripe_;
    const Scratch& scratch_;
    const Bounds bounds_;
    Queue queues_[kOpaqueShades + 1];
    std::int32_t mixed_ = 0;
};

}  // namespace

void draw_stripe(const Scene& scene, const Stripe& stripe, const Scratch& scratch) {
    StripeDrawing(scene, stripe, scratch).draw();
}

}  // namespace viaface::raster::VIAFACE_KERNEL
