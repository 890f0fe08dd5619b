// What is in front in a stripe: in the middle of each pixel, and at the samples of fine ones. For
// raster_kernel.cpp alone.
#pragma once

#include "synth/picture/raster_scene.hpp"
#include "synth/picture/raster_triangles.hpp"
#include "synth/picture/raster_wide.hpp"

namespace viaface::raster::VIAFACE_KERNEL {
namespace {

constexpr std::int32_t kAhead = 6;  // facets
constexpr std::int32_t kFacetBits = 0x7fffffff, kNotStill = ~kFacetBits;

// A stripe and where its places are in the arrays.
struct StripePlaces {
    const Scene& scene;
    const Stripe& list;
    const Scratch& scratch;
    const Bounds bounds = list.bounds;

    VIAFACE_INLINE std::int32_t sample(std::int32_t x, std::int32_t y) const {
        return ((y - bounds.bottom) * (scene.width + 1) + x - bounds.left) * kSamples;
    }
    VIAFACE_INLINE std::int32_t middle_of(std::int32_t x, std::int32_t y) const {
        return (y - bounds.bottom) * (scene.width + kPixelsBeyond) + x - bounds.left;
    }

    // A bit for each of the fine ones among 32 pixels.
    VIAFACE_INLINE std::uint32_t fine(std::int32_t x, std::int32_t y) const {
        return bits_at(scene.fine + y * scene.fine_words, x);
    }
    static VIAFACE_INLINE std::uint32_t bits_at(const std::uint64_t* row, std::int32_t x) {
        static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__);
        std::uint64_t bits;
        __builtin_memcpy(&bits, reinterpret_cast<const std::uint8_t*>(row) + (x >> 3), sizeof bits);
        return std::uint32_t(bits >> (x & 7));
    }

    // Where a facet may show in the stripe.
    VIAFACE_INLINE Bounds bounds_of(std::uint32_t facet) const {
        const Bounds box = common(scene.triangles.boxes[facet], bounds);
        return scene.facets[facet].inside ? common(box, scene.opening) : box;
    }
};

class Settling {
  public:
    explicit VIAFACE_INLINE Settling(const StripePlaces& stripe) : stripe_(stripe), scene_(stripe.scene) {}

    VIAFACE_INLINE void clear() {
        const std::size_t width = std::size_t(stripe_.bounds.right - stripe_.bounds.left);
        for (std::int32_t i = 0; i < scene_.fine_words; ++i) fine_columns_[i] = 0;
        for (std::int32_t y = stripe_.bounds.bottom; y < stripe_.bounds.top; ++y) {
            const std::int32_t middles = stripe_.middle_of(stripe_.bounds.left, y);
            __builtin_memset(stripe_.scratch.middles.nearness + middles, 0, width * 4);
            __builtin_memset(stripe_.scratch.middles.seen + middles, 0, width * 4);
            for (std::int32_t i = 0; i < scene_.fine_words; ++i)
                fine_columns_[i] |= scene_.fine[y * scene_.fine_words + i];
            for (std::int32_t x = stripe_.bounds.left; x < stripe_.bounds.right; x += 32) {
                if (stripe_.fine(x, y) != 0) clear_samples(x, y, smaller(32, stripe_.bounds.right - x) + 1);
            }
        }
    }

    // What is in front. The first of the lashes.
    std::int32_t settle() {
        for (std::int32_t i = 0; i < stripe_.list.count; ++i) {
            const std::uint32_t facet = stripe_.list.facets[i];
            prefetch(i + kAhead);
            if (scene_.facets[facet].shade == Shade::kLash) return i;
            const Bounds bounds = stripe_.bounds_of(facet);
            const EightInt id = eight(std::int32_t(facet + 1) | (scene_.still[facet] != 0 ? 0 : kNotStill));
            if (!scene_.facets[facet].fine) {
                settle_middles(facet, bounds, id);
                if (!any_fine(bounds)) continue;
            }
            settle_samples(facet, bounds, id);
        }
        return stripe_.list.count;
    }

  private:
    VIAFACE_INLINE void clear_samples(std::int32_t x, std::int32_t y, std::int32_t pixels) {
        const std::size_t bytes = std::size_t(pixels) * kSamples * 4;
        __builtin_memset(stripe_.scratch.samples.nearness + stripe_.sample(x, y), 0, bytes);
        __builtin_memset(stripe_.scratch.samples.seen + stripe_.sample(x, y), 0, bytes);
    }

    VIAFACE_INLINE bool any_fine(const Bounds& box) const {
        for (std::int32_t left = box.left; left < box.right; left += 32) {
            const std::uint32_t within = ~0u >> (32 - smaller(32, box.right - left));
            if ((StripePlaces::bits_at(fine_columns_, left) & within) == 0) continue;
            for (std::int32_t y = box.bottom; y < box.top; ++y) {
                if ((stripe_.fine(left, y) & within) != 0) return true;
            }
        }
        return false;
    }

    static VIAFACE_INLINE void keep_nearer(const Front& front, std::ptrdiff_t at, EightInt id,
                                           EightInt outside, Eight nearness) {
        const auto before = load<Eight>(front.nearness + at);
        const EightInt in_front = (outside >= 0) & (nearness > before);
        store(front.nearness + at, in_front ? nearness : before);
        store(front.seen + at, in_front ? id : load<EightInt>(front.seen + at));
    }

    // What will be settled after a few more facets.
    VIAFACE_INLINE void prefetch(std::int32_t i) const {
        const std::uint32_t facet = stripe_.list.facets[smaller(i, stripe_.list.count - 1)];
        __builtin_prefetch(scene_.facets + facet);
        __builtin_prefetch(scene_.triangles.triangles + facet);
        __builtin_prefetch(scene_.triangles.boxes + facet);
    }

    VIAFACE_INLINE void settle_middles(std::uint32_t facet, const Bounds& bounds, EightInt id) {
        const Triangle& triangle = scene_.triangles.triangles[facet];
        const std::int32_t row = scene_.width + kPixelsBeyond;
        const auto visit = [&](Walk walk, const Bounds& block) __attribute__((always_inline)) {
            const bool two = block.right - block.left > kMiddles.pixels;
            std::int32_t at = stripe_.middle_of(block.left, block.bottom);
            for (std::int32_t y = block.bottom; y < block.top; ++y, at += row) {
                keep_nearer(stripe_.scratch.middles, at, id, walk.outside(), walk.nearness(triangle));
                if (two) {
                    Walk next = walk;
                    next.go_right(float(kMiddles.pixels));
                    keep_nearer(stripe_.scratch.middles, at + kMiddles.pixels, id, next.outside(),
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
                std::int32_t at = stripe_.sample(block.left, y);
                for (std::uint32_t left = stripe_.fine(block.left, y) & within; left != 0; left >>= 2) {
                    const EightInt outside = there.outside();
                    if ((left & 3) != 0 && negative_lanes(outside) != 0xff)
                        keep_nearer(stripe_.scratch.samples, at, id, outside, there.nearness(triangle));
                    there.go_right(2.0f);
                    at += 2 * kSamples;
                }
                walk.go_up();
            }
        };
        for_blocks(scene_, facet, bounds, kTwoPixels, visit);
    }

    const StripePlaces& stripe_;
    const Scene& scene_;
    std::uint64_t fine_columns_[kMostFineWords];  // of all rows of the stripe
};

}  // namespace
}  // namespace viaface::raster::VIAFACE_KERNEL
