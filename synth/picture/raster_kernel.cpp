// Compiled once per instruction set, which VIAFACE_KERNEL names.
#include "synth/picture/raster_fragments.hpp"
#include "synth/picture/raster_scene.hpp"
#include "synth/picture/raster_shades.hpp"
#include "synth/picture/raster_triangles.hpp"
#include "synth/picture/raster_wide.hpp"

namespace viaface::raster::VIAFACE_KERNEL {
namespace {

// Where a pixel's samples are, from its middle, in pixels.
constexpr Four kSampleRight = {-0.125f, 0.375f, -0.375f, 0.125f};
constexpr Four kSampleUp = {-0.375f, -0.125f, 0.125f, 0.375f};

VIAFACE_INLINE Four magnitude(Four v) { return greater(v, -v); }

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
    VIAFACE_INLINE std::int32_t middle_of(std::int32_t x, std::int32_t y) const {
        return (y - bounds_.bottom) * (scene_.width + kPixelsBeyond) + x - bounds_.left;
    }
    VIAFACE_INLINE std::int32_t pixel(std::int32_t x, std::int32_t y) const {
        return (y - bounds_.bottom) * scene_.width + x - bounds_.left;
    }
    VIAFACE_INLINE std::uint32_t& rgba(std::int32_t x, std::int32_t y) const {
        return scene_.rgba[std::int64_t(y) * scene_.width + x];
    }
    VIAFACE_INLINE std::uint32_t& alone(std::int32_t x, std::int32_t y) const {
        return scene_.alone[std::int64_t(y) * scene_.width + x];
    }
    VIAFACE_INLINE std::uint32_t background(std::int32_t x, std::int32_t y) const {
        return scene_.background[std::int64_t(y) * scene_.width + x];
    }

    // A bit for each of the fine ones among 32 pixels.
    VIAFACE_INLINE std::uint32_t fine(std::int32_t x, std::int32_t y) const {
        const std::uint64_t* word = scene_.fine + std::int64_t(y) * scene_.fine_words + (x >> 6);
        const int shift = x & 63;
        return std::uint32_t(shift <= 32 ? word[0] >> shift : word[0] >> shift | word[1] << (64 - shift));
    }

    VIAFACE_INLINE bool any_fine(const Bounds& box) const {
        std::uint32_t any = 0;
        for (std::int32_t left = box.left; left < box.right; left += 32) {
            const std::uint32_t within = ~0u >> (32 - smaller(32, box.right - left));
            for (std::int32_t y = box.bottom; y < box.top; ++y) any |= fine(left, y) & within;
        }
        return any != 0;
    }

    VIAFACE_INLINE void clear() {
        const std::size_t width = std::size_t(bounds_.right - bounds_.left);
        for (std::int32_t y = bounds_.bottom; y < bounds_.top; ++y) {
            const std::int32_t middles = middle_of(bounds_.left, y);
            __builtin_memset(scratch_.middles.nearness + middles, 0, width * 4);
            __builtin_memset(scratch_.middles.seen + middles, 0, width * 4);
            for (std::int32_t x = bounds_.left; x < bounds_.right; x += 32) {
                if (fine(x, y) != 0) clear_samples(x, y, smaller(32, bounds_.right - x) + 1);
            }
        }
    }

    VIAFACE_INLINE void clear_samples(std::int32_t x, std::int32_t y, std::int32_t pixels) {
        const std::size_t bytes = std::size_t(pixels) * kSamples * 4;
        __builtin_memset(scratch_.samples.nearness + sample(x, y), 0, bytes);
        __builtin_memset(scratch_.samples.seen + sample(x, y), 0, bytes);
    }

    Prepared prepare(std::int32_t i) {
        const Facet& facet = scene_.facets[stripe_.facets[i]];
        return VIAFACE_KERNEL::prepare(scene_, facet.inside ? common(bounds_, scene_.opening) : bounds_,
                                       facet, scratch_.surfaces[i]);
    }

    static VIAFACE_INLINE void keep_nearer(const Front& front, std::ptrdiff_t at, WideInt id, WideInt outside,
                                           Wide nearness) {
        const auto before = load<Wide>(front.nearness + at);
        const WideInt in_front = (outside >= 0) & (nearness > before);
        store(front.nearness + at, in_front ? nearness : before);
        store(front.seen + at, in_front ? id : load<WideInt>(front.seen + at));
    }

    // What is in front. The first of the lashes.
    std::int32_t settle() {
        const Front middles = scratch_.middles, samples = scratch_.samples;
        for (std::int32_t i = 0; i < stripe_.count; ++i) {
            const Facet& facet = scene_.facets[stripe_.facets[i]];
            if (facet.shade == Shade::kLash) return i;
            const Prepared p = prepare(i);
            if (!p.drawn) continue;
            const WideInt id = wide(i + 1);
            if (!facet.fine) {
                for_pixels(
                    p, scratch_.surfaces[i], kMiddles, AllPixels(),
                    [&](std::int32_t x, std::int32_t y, WideInt outside, Wide nearness) __attribute__((
                        always_inline)) { keep_nearer(middles, middle_of(x, y), id, outside, nearness); });
                if (!any_fine(p.bounds)) continue;
            }
            for_pixels(
                p, scratch_.surfaces[i], kTwoPixels,
                [&](std::int32_t x, std::int32_t y) __attribute__((always_inline)) { return fine(x, y); },
                [&](std::int32_t x, std::int32_t y, WideInt outside, Wide nearness) __attribute__((
                    always_inline)) { keep_nearer(samples, sample(x, y), id, outside, nearness); });
        }
        return stripe_.count;
    }

    void resolve() {
        mixed_ = 0;
        for (std::int32_t y = bounds_.bottom; y < bounds_.top; ++y) {
            for (std::int32_t x = bounds_.left; x < bounds_.right; x += 32) {
                std::uint32_t fine_ones = fine(x, y);
                const std::int32_t end = smaller(x + 32, bounds_.right);
                for (std::int32_t at = x; at < end; ++at, fine_ones >>= 1) {
                    if (fine_ones & 1)
                        resolve_fine(at, y);
                    else
                        resolve_alone(at, y, scratch_.middles.seen[middle_of(at, y)]);
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

    VIAFACE_INLINE void resolve_fine(std::int32_t x, std::int32_t y) {
        const std::int32_t* seen = scratch_.samples.seen + sample(x, y);
        if (((seen[0] ^ seen[1]) | (seen[0] ^ seen[2]) | (seen[0] ^ seen[3])) == 0)
            return resolve_alone(x, y, seen[0]);
        alone(x, y) = 0;
        resolve_mixed(x, y, seen);
    }

    VIAFACE_INLINE void resolve_alone(std::int32_t x, std::int32_t y, std::int32_t id) {
        std::uint32_t& before = alone(x, y);
        if (id == 0) {
            before = 0;
            rgba(x, y) = background(x, y);
            return;
        }
        const std::uint32_t facet = stripe_.facets[id - 1];
        if (before == facet + 1 && scene_.still[facet] != 0) return;
        before = facet + 1;
        push({x, y, id - 1, kSamples});
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
        const auto near = load<Four>(scratch_.samples.nearness + (samples - scratch_.samples.seen));
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
        const Lit lit = light(scene_, scratch_.surfaces, queue.fragments);
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
        alone(f.x, f.y) = 0;
        std::uint32_t& to = rgba(f.x, f.y);
        const float share = cover * float(f.samples) * (1.0f / kSamples);
        std::uint32_t mixed = kOpaque;
        for (int shift = 0; shift < 24; shift += 8) {
            const float under = float(to >> shift & 255), over = float(colour >> shift & 255);
            mixed |= std::uint32_t(under + share * (over - under) + 0.5f) << shift;
        }
        to = mixed;
    }

    void blend(std::int32_t first) {
        for (std::int32_t i = first; i < stripe_.count; ++i) {
            const Prepared p = prepare(i);
            if (!p.drawn) continue;
            for_pixels(
                p, scratch_.surfaces[i], kTwoPixels, AllPixels(),
                [&](std::int32_t x, std::int32_t y, WideInt outside,
                    Wide nearness) __attribute__((always_inline)) {
                    const Wide before = load<Wide>(scratch_.samples.nearness + sample(x, y));
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
