// Fragments on their way to colours: they wait until there are kLanes of a kind. For raster_kernel.cpp alone.
#pragma once

#include "synth/picture/raster_fragments.hpp"
#include "synth/picture/raster_scene.hpp"
#include "synth/picture/raster_shades.hpp"
#include "synth/picture/raster_wide.hpp"

namespace viaface::raster::VIAFACE_KERNEL {
namespace {

constexpr std::int32_t kOpaque = std::int32_t(255u << 24);

// Colours of a pixel's samples add up in 10 bits each.
constexpr std::uint32_t kOneOfEach = 1 | 1 << 10 | 1 << 20;
VIAFACE_INLINE std::uint32_t spread(std::uint32_t rgba) {
    return (rgba & 255) | (rgba >> 8 & 255) << 10 | (rgba >> 16 & 255) << 20;
}
VIAFACE_INLINE std::uint32_t mean_of_samples(std::uint32_t sum) {
    sum += kSamples / 2 * kOneOfEach;
    return (sum >> 2 & 255) | (sum >> 12 & 255) << 8 | (sum >> 22 & 255) << 16 | std::uint32_t(kOpaque);
}
static_assert(kSamples == 4);

class Shading {
  public:
    VIAFACE_INLINE Shading(const Scene& scene, const Bounds& bounds, std::uint32_t* sums)
        : scene_(scene), first_(bounds.bottom * scene.width + bounds.left), sums_(sums) {}

    // A pixel's place in the picture's arrays.
    VIAFACE_INLINE std::int32_t at(std::int32_t x, std::int32_t y) const { return y * scene_.width + x; }
    VIAFACE_INLINE std::uint32_t& sum(std::int32_t at) const { return sums_[at - first_]; }

    // `samples` of a pixel see the facet.
    VIAFACE_INLINE void push(std::int32_t x, std::int32_t y, std::int32_t facet, std::int32_t samples) {
        const Shade shade = scene_.facets[facet].shade;
        Queue& queue = queues_[int(shade)];
        const int to = queue.count++;
        queue.x[to] = x, queue.y[to] = y, queue.at[to] = at(x, y);
        queue.facet[to] = facet, queue.samples[to] = samples;
        if (queue.count >= kAtOnce) shade_some(shade);
    }

    // All samples of those of eight pixels that have a bit in `lanes`; facets of the skin.
    VIAFACE_INLINE void push_skin(std::int32_t x, std::int32_t y, EightInt facets, unsigned lanes) {
        constexpr EightInt kPlaces = {0, 1, 2, 3, 4, 5, 6, 7};
        Queue& queue = queues_[int(Shade::kSkin)];
        const int to = queue.count;
        const EightInt right = packed(kPlaces, lanes);
        store(queue.x + to, right + x);
        store(queue.y + to, eight(y));
        store(queue.at + to, right + at(x, y));
        store(queue.facet + to, packed(facets, lanes));
        store(queue.samples + to, eight(kSamples));
        queue.count += __builtin_popcount(lanes);
        if (queue.count >= kAtOnce) flush<Shade::kSkin>();
    }

    VIAFACE_INLINE void finish() {
        for (int shade = 0; shade <= kOpaqueShades; ++shade) {
            if (queues_[shade].count > 0) shade_some(Shade(shade));
        }
    }

  private:
    static constexpr int kAtOnce = kLanes;
    struct Queue {
        std::int32_t x[2 * kAtOnce], y[2 * kAtOnce], at[2 * kAtOnce];
        std::int32_t facet[2 * kAtOnce], samples[2 * kAtOnce];
        int count = 0;

        VIAFACE_INLINE void fill_up() {
            for (int i = count; i < kAtOnce; ++i) x[i] = x[0], y[i] = y[0], facet[i] = facet[0];
        }
        VIAFACE_INLINE void drop_some() {
            std::int32_t* const arrays[] = {x, y, at, facet, samples};
            for (std::int32_t* array : arrays) store(array, load<WideInt>(array + kAtOnce));
            count = larger(0, count - kAtOnce);
        }
    };

    VIAFACE_INLINE void shade_some(Shade shade) {
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
        queue.fill_up();
        const Lit lit = light(scene_, queue.facet, load<WideInt>(queue.x), load<WideInt>(queue.y));
        const Three c = shaded<shade>(lit);
        const WideInt colour = byte(filmic(c.x)) | byte(filmic(c.y)) << 8 | byte(filmic(c.z)) << 16;
        const int count = smaller(queue.count, kAtOnce);
        if constexpr (shade == Shade::kLash)
            lay_over(queue, count, colour, lit.cover);
        else
            write(queue, count, colour);
        queue.drop_some();
    }

    VIAFACE_INLINE void write(const Queue& queue, int count, WideInt colour) const {
        std::int32_t colours[kAtOnce];
        store(colours, colour | kOpaque);
        const WideInt part = load<WideInt>(queue.samples) != kSamples;
        if (count == kAtOnce && negative_lanes(part) == 0) {
            for (int i = 0; i < kAtOnce; ++i) scene_.rgba[queue.at[i]] = std::uint32_t(colours[i]);
            return;
        }
        for (int i = 0; i < count; ++i) {
            const std::int32_t at = queue.at[i], samples = queue.samples[i];
            if (samples == kSamples)
                scene_.rgba[at] = std::uint32_t(colours[i]);
            else
                sum(at) += std::uint32_t(samples) * spread(std::uint32_t(colours[i]));
        }
    }

    VIAFACE_INLINE void lay_over(const Queue& queue, int count, WideInt colour, Wide cover) const {
        std::uint32_t colours[kAtOnce];
        float covers[kAtOnce];
        store(colours, colour);
        store(covers, cover);
        for (int i = 0; i < count; ++i)
            lay_over(scene_.rgba[queue.at[i]], colours[i],
                     covers[i] * float(queue.samples[i]) * (1.0f / kSamples));
    }

    static VIAFACE_INLINE void lay_over(std::uint32_t& to, std::uint32_t colour, float share) {
        std::uint32_t mixed = std::uint32_t(kOpaque);
        for (int shift = 0; shift < 24; shift += 8) {
            const float under = float(to >> shift & 255), over = float(colour >> shift & 255);
            mixed |= std::uint32_t(under + share * (over - under) + 0.5f) << shift;
        }
        to = mixed;
    }

    const Scene& scene_;
    const std::int32_t first_;  // pixel of the stripe, which sums_ begins with
    std::uint32_t* const sums_;
    Queue queues_[kOpaqueShades + 1];
};

}  // namespace
}  // namespace viaface::raster::VIAFACE_KERNEL
