// Compiled once per instruction set, which VIAFACE_KERNEL names.
#include "synth/picture/raster_placing.hpp"
#include "synth/picture/raster_scene.hpp"
#include "synth/picture/raster_set_up.hpp"
#include "synth/picture/raster_shading.hpp"
#include "synth/picture/raster_triangles.hpp"
#include "synth/picture/raster_turn.hpp"
#include "synth/picture/raster_wide.hpp"

namespace viaface::raster::VIAFACE_KERNEL {
namespace {

// Where a pixel's samples are, from its middle, in pixels.
constexpr Four kSampleRight = {-0.125f, 0.375f, -0.375f, 0.125f};
constexpr Four kSampleUp = {-0.375f, -0.125f, 0.125f, 0.375f};

constexpr std::int32_t kAhead = 6;  // facets
constexpr std::int32_t kFacetBits = 0x7fffffff, kNotStill = ~kFacetBits;

VIAFACE_INLINE Four magnitude(Four v) { return greater(v, -v); }

class StripeDrawing {
  public:
    VIAFACE_INLINE StripeDrawing(const Scene& scene, const Stripe& stripe, const Scratch& scratch)
        : scene_(scene),
          stripe_(stripe),
          scratch_(scratch),
          bounds_(stripe.bounds),
          shading_(scene, stripe.bounds, scratch.sums) {}

    VIAFACE_INLINE void draw() {
        clear();
        const std::int32_t lashes = settle();
        resolve();
        blend(lashes);
    }

  private:
    VIAFACE_INLINE std::int32_t sample(std::int32_t x, std::int32_t y) const {
        return ((y - bounds_.bottom) * (scene_.width + 1) + x - bounds_.left) * kSamples;
    }
    VIAFACE_INLINE std::int32_t middle_of(std::int32_t x, std::int32_t y) const {
        return (y - bounds_.bottom) * (scene_.width + kPixelsBeyond) + x - bounds_.left;
    }

    // A bit for each of the fine ones among 32 pixels.
    VIAFACE_INLINE std::uint32_t fine(std::int32_t x, std::int32_t y) const {
        return bits_at(scene_.fine + y * scene_.fine_words, x);
    }
    static VIAFACE_INLINE std::uint32_t bits_at(const std::uint64_t* row, std::int32_t x) {
        static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__);
        std::uint64_t bits;
        __builtin_memcpy(&bits, reinterpret_cast<const std::uint8_t*>(row) + (x >> 3), sizeof bits);
        return std::uint32_t(bits >> (x & 7));
    }

    VIAFACE_INLINE bool any_fine(const Bounds& box) const {
        for (std::int32_t left = box.left; left < box.right; left += 32) {
            const std::uint32_t within = ~0u >> (32 - smaller(32, box.right - left));
            if ((bits_at(fine_columns_, left) & within) == 0) continue;
            for (std::int32_t y = box.bottom; y < box.top; ++y) {
                if ((fine(left, y) & within) != 0) return true;
            }
        }
        return false;
    }

    VIAFACE_INLINE void clear() {
        const std::size_t width = std::size_t(bounds_.right - bounds_.left);
        for (std::int32_t i = 0; i < scene_.fine_words; ++i) fine_columns_[i] = 0;
        for (std::int32_t y = bounds_.bottom; y < bounds_.top; ++y) {
            const std::int32_t middles = middle_of(bounds_.left, y);
            __builtin_memset(scratch_.middles.nearness + middles, 0, width * 4);
            __builtin_memset(scratch_.middles.seen + middles, 0, width * 4);
            for (std::int32_t i = 0; i < scene_.fine_words; ++i)
                fine_columns_[i] |= scene_.fine[y * scene_.fine_words + i];
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

    // Where a facet may show in the stripe.
    VIAFACE_INLINE Bounds bounds_of(std::uint32_t facet) const {
        const Bounds bounds = common(scene_.triangles.boxes[facet], bounds_);
        return scene_.facets[facet].inside ? common(bounds, scene_.opening) : bounds;
    }

    static VIAFACE_INLINE void keep_nearer(const Front& front, std::ptrdiff_t at, EightInt id,
                                           EightInt outside, Eight nearness) {
        const auto before = load<Eight>(front.nearness + at);
        const EightInt in_front = (outside >= 0) & (nearness > before);
        store(front.nearness + at, in_front ? nearness : before);
        store(front.seen + at, in_front ? id : load<EightInt>(front.seen + at));
    }

    // What is in front. The first of the lashes.
    std::int32_t settle() {
        for (std::int32_t i = 0; i < stripe_.count; ++i) {
            const std::uint32_t facet = stripe_.facets[i];
            prefetch(i + kAhead);
            if (scene_.facets[facet].shade == Shade::kLash) return i;
            const Bounds bounds = bounds_of(facet);
            const EightInt id = eight(std::int32_t(facet + 1) | (scene_.still[facet] != 0 ? 0 : kNotStill));
            if (!scene_.facets[facet].fine) {
                settle_middles(facet, bounds, id);
                if (!any_fine(bounds)) continue;
            }
            settle_samples(facet, bounds, id);
        }
        return stripe_.count;
    }

    // What will be settled after a few more facets.
    VIAFACE_INLINE void prefetch(std::int32_t i) const {
        const std::uint32_t facet = stripe_.facets[smaller(i, stripe_.count - 1)];
        __builtin_prefetch(scene_.facets + facet);
        __builtin_prefetch(scene_.triangles.triangles + facet);
        __builtin_prefetch(scene_.triangles.boxes + facet);
    }

    VIAFACE_INLINE void settle_middles(std::uint32_t facet, const Bounds& bounds, EightInt id) {
        const Triangle& triangle = scene_.triangles.triangles[facet];
        const std::int32_t row = scene_.width + kPixelsBeyond;
        const auto visit = [&](Walk walk, const Bounds& block) __attribute__((always_inline)) {
            const bool two = block.right - block.left > kMiddles.pixels;
            std::int32_t at = middle_of(block.left, block.bottom);
            for (std::int32_t y = block.bottom; y < block.top; ++y, at += row) {
                keep_nearer(scratch_.middles, at, id, walk.outside(), walk.nearness(triangle));
                if (two) {
                    Walk next = walk;
                    next.go_right(float(kMiddles.pixels));
                    keep_nearer(scratch_.middles, at + kMiddles.pixels, id, next.outside(),
                                next.nearness(triangle));
                }
                walk.go_up();
            }
        };
        for_blocks(scene_, facet, bounds, kMiddles, visit);
    }

    VIAFACE_INLINE void settle_samples(std::uint32_t facet, const Bounds& bounds, EightInt id) {
        const Triangle& triangle = scene_.triangles.triangles[facet];
        const auto visit = [&](Walk walk, const Bounds& block) __attribute__((always_inline)) {
            const std::uint32_t within = ~(~0u << (block.right - block.left));
            for (std::int32_t y = block.bottom; y < block.top; ++y) {
                Walk there = walk;
                std::int32_t at = sample(block.left, y);
                for (std::uint32_t left = fine(block.left, y) & within; left != 0; left >>= 2) {
                    const EightInt outside = there.outside();
                    if ((left & 3) != 0 && negative_lanes(outside) != 0xff)
                        keep_nearer(scratch_.samples, at, id, outside, there.nearness(triangle));
                    there.go_right(2.0f);
                    at += 2 * kSamples;
                }
                walk.go_up();
            }
        };
        for_blocks(scene_, facet, bounds, kTwoPixels, visit);
    }

    void resolve() {
        mixed_ = 0;
        for (std::int32_t y = bounds_.bottom; y < bounds_.top; ++y) {
            for (std::int32_t x = bounds_.left; x < bounds_.right; x += 8) {
                const unsigned within = 0xffu >> (8 - smaller(8, bounds_.right - x));
                const unsigned fine_ones = fine(x, y) & within;
                resolve_middles(x, y, within & ~fine_ones);
                for (unsigned left = fine_ones; left != 0; left &= left - 1)
                    resolve_fine(x + __builtin_ctz(left), y);
            }
        }
        shading_.finish();
        for (std::int32_t i = 0; i < mixed_; ++i) {
            const std::int32_t at = scratch_.mixed[i];
            scene_.rgba[at] = mean_of_samples(shading_.sum(at));
        }
    }

    // Those of eight pixels that have a bit in `coarse`.
    VIAFACE_INLINE void resolve_middles(std::int32_t x, std::int32_t y, unsigned coarse) {
        const std::int32_t* const seen = scratch_.middles.seen + middle_of(x, y);
        if (x + 8 <= bounds_.right) return resolve_eight(x, y, coarse, load<EightInt>(seen));
        for (; coarse != 0; coarse &= coarse - 1) {
            const int i = __builtin_ctz(coarse);
            resolve_alone(x + i, y, seen[i]);
        }
    }

    VIAFACE_INLINE void resolve_eight(std::int32_t x, std::int32_t y, unsigned coarse, EightInt seen) {
        constexpr EightInt kBits = {1, 2, 4, 8, 16, 32, 64, 128};
        const std::int32_t at = shading_.at(x, y);
        const EightInt chosen = (kBits & std::int32_t(coarse)) != 0, facets = seen & kFacetBits;
        const auto before = load<EightInt>(scene_.alone + at);
        store(scene_.alone + at, chosen ? facets : before);
        const unsigned bare = negative_lanes(seen == 0) & coarse;
        for (unsigned left = bare; left != 0; left &= left - 1) {
            const int i = __builtin_ctz(left);
            scene_.rgba[at + i] = scene_.background[at + i];
        }
        const unsigned drawn = negative_lanes(seen != before) & coarse & ~bare;
        if (drawn != 0) shading_.push_skin(x, y, facets - 1, drawn);
    }

    // A pixel in which nothing or one facet is seen.
    VIAFACE_INLINE void resolve_alone(std::int32_t x, std::int32_t y, std::int32_t seen) {
        const std::int32_t at = shading_.at(x, y);
        std::uint32_t& before = scene_.alone[at];
        if (seen == 0) {
            before = 0;
            scene_.rgba[at] = scene_.background[at];
        } else if (before != std::uint32_t(seen)) {
            before = std::uint32_t(seen & kFacetBits);
            shading_.push(x, y, facet_of(seen), kSamples);
        }
    }

    VIAFACE_INLINE void resolve_fine(std::int32_t x, std::int32_t y) {
        const std::int32_t* seen = scratch_.samples.seen + sample(x, y);
        if (((seen[0] ^ seen[1]) | (seen[0] ^ seen[2]) | (seen[0] ^ seen[3])) == 0)
            return resolve_alone(x, y, seen[0]);
        scene_.alone[shading_.at(x, y)] = 0;
        resolve_mixed(x, y, seen);
    }

    // Shares a pixel's samples out among surfaces that do not go on in each other: another material, a fold
    // or a step is between them.
    __attribute__((noinline)) void resolve_mixed(std::int32_t x, std::int32_t y,
                                                 const std::int32_t* samples) {
        const auto seen = load<FourInt>(samples);
        const auto near = load<Four>(scratch_.samples.nearness + (samples - scratch_.samples.seen));
        Four planes[kSamples];
        for (int i = 0; i < kSamples; ++i)
            planes[i] = load<Four>(&scene_.triangles.triangles[larger(facet_of(samples[i]), 0)].nearness);
        transpose_fours(planes);
        const Four reach = scene_.step * near, fold = scene_.fold * near;
        unsigned left = negative_lanes(seen != 0);
        const std::int32_t at = shading_.at(x, y);
        shading_.sum(at) = std::uint32_t(kSamples - __builtin_popcount(left)) * spread(scene_.background[at]);
        for (bool first = true; left != 0; first = false) {
            const std::int32_t id = samples[__builtin_ctz(left)], facet = facet_of(id);
            const Triangle& t = scene_.triangles.triangles[facet];
            const Bounds& box = scene_.triangles.boxes[facet];
            const Four gap = t.nearness + (kSampleRight + float(x - box.left)) * t.nearness_right +
                             (kSampleUp + float(y - box.bottom)) * t.nearness_up - near;
            const Four turn = magnitude(planes[1] - t.nearness_right) + magnitude(planes[2] - t.nearness_up);
            const FourInt goes_on = (magnitude(gap) < reach) & (turn < fold) & (planes[3] == t.material);
            const unsigned one = negative_lanes(goes_on | (seen == id)) & left;
            const std::int32_t count = __builtin_popcount(one);
            left &= ~one;
            if (first && count < kSamples) scratch_.mixed[mixed_++] = at;
            shading_.push(x, y, facet, count);
        }
    }

    static VIAFACE_INLINE std::int32_t facet_of(std::int32_t seen) { return (seen & kFacetBits) - 1; }

    void blend(std::int32_t first) {
        for (std::int32_t i = first; i < stripe_.count; ++i) {
            const std::uint32_t facet = stripe_.facets[i];
            for_blocks(
                scene_, facet, bounds_of(facet),
                kTwoPixels, [&](Walk walk, const Bounds& block) __attribute__((always_inline)) {
                    blend(facet, walk, block);
                });
        }
        shading_.finish();
    }

    VIAFACE_INLINE void blend(std::uint32_t facet, Walk walk, const Bounds& block) {
        const Triangle& triangle = scene_.triangles.triangles[facet];
        for (std::int32_t y = block.bottom; y < block.top; ++y) {
            Walk there = walk;
            for (std::int32_t x = block.left; x < block.right; x += 2) {
                const Eight before = load<Eight>(scratch_.samples.nearness + sample(x, y));
                const EightInt in_front = (there.outside() >= 0) & (there.nearness(triangle) > before);
                const unsigned lanes = negative_lanes(in_front);
                lay(x, y, facet, __builtin_popcount(lanes & 15));
                if (x + 1 < block.right) lay(x + 1, y, facet, __builtin_popcount(lanes >> 4));
                there.go_right(2.0f);
            }
            walk.go_up();
        }
    }

    VIAFACE_INLINE void lay(std::int32_t x, std::int32_t y, std::uint32_t facet, std::int32_t samples) {
        if (samples == 0) return;
        scene_.alone[shading_.at(x, y)] = 0;
        shading_.push(x, y, std::int32_t(facet), samples);
    }

    const Scene& scene_;
    const Stripe& stripe_;
    const Scratch& scratch_;
    const Bounds bounds_;
    Shading shading_;
    std::int32_t mixed_ = 0;
    std::uint64_t fine_columns_[kMostFineWords];  // of all rows of the stripe
};

void draw(const Scene& scene, const Stripe& stripe, const Scratch& scratch) {
    StripeDrawing(scene, stripe, scratch).draw();
}

}  // namespace

const Kernel kKernel = {place, set_up, draw};

}  // namespace viaface::raster::VIAFACE_KERNEL
