// Compiled once per instruction set, which VIAFACE_KERNEL names.
#include "synth/picture/raster_placing.hpp"
#include "synth/picture/raster_scene.hpp"
#include "synth/picture/raster_set_up.hpp"
#include "synth/picture/raster_settling.hpp"
#include "synth/picture/raster_shading.hpp"
#include "synth/picture/raster_triangles.hpp"
#include "synth/picture/raster_turn.hpp"
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
        : stripe_{scene, stripe, scratch}, scene_(scene), shading_(scene, stripe.bounds, scratch.sums) {}

    VIAFACE_INLINE void draw() {
        Settling settling(stripe_);
        settling.clear();
        const std::int32_t lashes = settling.settle();
        resolve();
        blend(lashes);
    }

  private:
    void resolve() {
        mixed_ = 0;
        for (std::int32_t y = stripe_.bounds.bottom; y < stripe_.bounds.top; ++y) {
            for (std::int32_t x = stripe_.bounds.left; x < stripe_.bounds.right; x += 8) {
                const unsigned within = 0xffu >> (8 - smaller(8, stripe_.bounds.right - x));
                const unsigned fine_ones = stripe_.fine(x, y) & within;
                resolve_middles(x, y, within & ~fine_ones);
                for (unsigned left = fine_ones; left != 0; left &= left - 1)
                    resolve_fine(x + __builtin_ctz(left), y);
            }
        }
        shading_.finish();
        for (std::int32_t i = 0; i < mixed_; ++i) {
            const std::int32_t at = stripe_.scratch.mixed[i];
            scene_.rgba[at] = mean_of_samples(shading_.sum(at));
        }
    }

    // Those of eight pixels that have a bit in `coarse`.
    VIAFACE_INLINE void resolve_middles(std::int32_t x, std::int32_t y, unsigned coarse) {
        const std::int32_t* const seen = stripe_.scratch.middles.seen + stripe_.middle_of(x, y);
        if (x + 8 <= stripe_.bounds.right) return resolve_eight(x, y, coarse, load<EightInt>(seen));
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
        const std::int32_t* seen = stripe_.scratch.samples.seen + stripe_.sample(x, y);
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
        const auto near =
            load<Four>(stripe_.scratch.samples.nearness + (samples - stripe_.scratch.samples.seen));
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
            if (first && count < kSamples) stripe_.scratch.mixed[mixed_++] = at;
            shading_.push(x, y, facet, count);
        }
    }

    static VIAFACE_INLINE std::int32_t facet_of(std::int32_t seen) { return (seen & kFacetBits) - 1; }

    void blend(std::int32_t first) {
        for (std::int32_t i = first; i < stripe_.list.count; ++i) {
            const std::uint32_t facet = stripe_.list.facets[i];
            for_blocks(
                scene_, facet, stripe_.bounds_of(facet),
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
                const Eight before = load<Eight>(stripe_.scratch.samples.nearness + stripe_.sample(x, y));
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

    const StripePlaces stripe_;
    const Scene& scene_;
    Shading shading_;
    std::int32_t mixed_ = 0;
};

void draw(const Scene& scene, const Stripe& stripe, const Scratch& scratch) {
    StripeDrawing(scene, stripe, scratch).draw();
}

}  // namespace

const Kernel kKernel = {place, set_up, draw};

}  // namespace viaface::raster::VIAFACE_KERNEL
