#include "synth/picture/fine_pixels.hpp"

#include <algorithm>
#include <map>

namespace viaface {
namespace {

using raster::Bounds;
using raster::Place;

constexpr std::int32_t kNear = raster::kSteps;  // from an outline, either way

std::int32_t floor_pixel(std::int32_t place) { return place >> 7; }
static_assert(1 << 7 == raster::kSteps);

// The way from `a` to `b` at a height, upwards.
std::int32_t along(const Place& a, const Place& b, std::int32_t height) {
    if (height <= a.y) return a.x;
    if (height >= b.y) return b.x;
    return a.x + std::int32_t(std::int64_t(b.x - a.x) * (height - a.y) / (b.y - a.y));
}

}  // namespace

FinePixels::FinePixels(std::span<const raster::Facet> facets, std::span<const int> weld, int width,
                       int height)
    : width_(width), height_(height), words_((width + 63) / 64 + 1), bits_(std::size_t(words_) * height) {
    std::map<std::pair<int, int>, std::size_t> known;  // edges by their welded nodes
    for (int i = 0; i < int(facets.size()); ++i) {
        if (facets[i].fine) covering_.push_back(i);
        if (facets[i].shade != raster::Shade::kSkin) continue;
        for (int k = 0; k < 3; ++k) {
            const int from = facets[i].node[k], to = facets[i].node[(k + 1) % 3];
            const auto [at, fresh] = known.try_emplace(std::minmax(weld[from], weld[to]), edges_.size());
            if (fresh)
                edges_.push_back({from, to, {i, kNone}});
            else
                edges_[at->second].facets[1] = i;
        }
    }
    std::erase_if(edges_, [&](const Edge& edge) {
        return std::ranges::none_of(edge.facets, [&](int i) { return i != kNone && !facets[i].fine; });
    });
}

void FinePixels::find(const Visible& visible) {
    std::ranges::fill(bits_, 0);
    for (const auto& [from, to, facets] : edges_) {
        const bool first = visible.seen[facets[0]], second = facets[1] != kNone && visible.seen[facets[1]];
        if (first != second) mark_outline(visible.nodes[from].place, visible.nodes[to].place);
    }
    for (const int i : covering_) {
        if (visible.seen[i]) mark(box_of(visible, i));
    }
}

void FinePixels::mark_outline(const Place& a, const Place& b) {
    const Place &low = a.y < b.y ? a : b, &high = a.y < b.y ? b : a;
    const std::int32_t last = floor_pixel(high.y + kNear);
    for (std::int32_t y = floor_pixel(low.y - kNear); y <= last; ++y) {
        const std::int32_t under = along(low, high, y * raster::kSteps - kNear),
                           over = along(low, high, (y + 1) * raster::kSteps + kNear);
        mark({floor_pixel(std::min(under, over) - kNear), y, floor_pixel(std::max(under, over) + kNear) + 1,
              y + 1});
    }
}

void FinePixels::mark(const Bounds& box) {
    const Bounds seen = raster::common(box, {0, 0, width_, height_});
    for (std::int32_t y = seen.bottom; y < seen.top; ++y) {
        std::uint64_t* const row = &bits_[std::size_t(y) * words_];
        for (std::int32_t x = seen.left; x < seen.right;) {
            const std::int32_t end = std::min(seen.right, (x | 63) + 1);
            row[x >> 6] |= (~std::uint64_t{0} >> (64 - (end - x))) << (x & 63);
            x = end;
        }
    }
}

}  // namespace viaface
