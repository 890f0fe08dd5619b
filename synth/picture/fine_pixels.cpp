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
    : words_((width + 63) / 64 + 1), bits_(std::size_t(words_) * height) {
    std::map<std::pair<int, int>, std::size_t> known;  // edges by their welded nodes
    for (int i = 0; i < int(facets.size()); ++i) {
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
    outlines_.resize(WorkPool::pieces(int(edges_.size())));
}

void FinePixels::find_outlines(std::span<const std::uint8_t> seen, WorkPool& pool) {
    pool.share_rows(int(edges_.size()), [&](int first, int end, int) {
        std::vector<int>& outlines = outlines_[first / WorkPool::kRowsAtOnce];
        outlines.clear();
        for (int i = first; i < end; ++i) {
            const auto [one, other] = edges_[i].facets;
            if ((seen[one] != 0) != (other != kNone && seen[other] != 0)) outlines.push_back(i);
        }
    });
}

void FinePixels::mark(std::span<const raster::Node> nodes, VisibleFacets visible, const Bounds& drawn) {
    std::ranges::fill(bits_, 0);
    for (const std::vector<int>& piece : outlines_) {
        for (const int i : piece) mark_outline(nodes[edges_[i].from].place, nodes[edges_[i].to].place, drawn);
    }
    for (const std::vector<VisibleFacet>& piece : visible) {
        for (const VisibleFacet& one : piece) {
            if (one.fine) mark(one.box);
        }
    }
}

void FinePixels::mark_outline(const Place& a, const Place& b, const Bounds& drawn) {
    const Place &low = a.y < b.y ? a : b, &high = a.y < b.y ? b : a;
    const std::int32_t end = std::min(drawn.top, floor_pixel(high.y + kNear) + 1);
    for (std::int32_t y = std::max(drawn.bottom, floor_pixel(low.y - kNear)); y < end; ++y) {
        const std::int32_t under = along(low, high, y * raster::kSteps - kNear),
                           over = along(low, high, (y + 1) * raster::kSteps + kNear);
        const Bounds row{floor_pixel(std::min(under, over) - kNear), y,
                         floor_pixel(std::max(under, over) + kNear) + 1, y + 1};
        mark(raster::common(row, drawn));
    }
}

void FinePixels::mark(const Bounds& box) {
    for (std::int32_t left = box.left; left < box.right;) {
        const std::int32_t right = std::min(box.right, (left | 63) + 1);
        const std::uint64_t bits = (~std::uint64_t{0} >> (64 - (right - left))) << (left & 63);
        for (std::int32_t y = box.bottom; y < box.top; ++y)
            bits_[std::size_t(y) * words_ + (left >> 6)] |= bits;
        left = right;
    }
}

}  // namespace viaface
