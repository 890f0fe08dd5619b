#include "synth/picture/stripe_lists.hpp"

#include <algorithm>

namespace viaface {

using raster::Bounds;

StripeLists::StripeLists(int height) : rows_((height + raster::kStripeRows - 1) / raster::kStripeRows) {}

void StripeLists::list(std::span<const Rect> rects, VisibleFacets visible) {
    count_ = 0;
    for (std::vector<int>& row : rows_) row.clear();
    for (const Rect& rect : rects) cut(rect);
    for (const std::vector<VisibleFacet>& piece : visible) {
        for (const VisibleFacet& one : piece) list_facet(one);
    }
    std::sort(stripes_.begin(), stripes_.begin() + std::ptrdiff_t(count_),
              [](const StripeList& a, const StripeList& b) { return a.facets.size() > b.facets.size(); });
}

void StripeLists::cut(const Rect& rect) {
    const int top = rect.bottom + rect.height;
    for (int bottom = rect.bottom; bottom < top;) {
        const int row = bottom / raster::kStripeRows;
        const int end = std::min(top, (row + 1) * raster::kStripeRows);
        if (stripes_.size() == count_) stripes_.emplace_back();
        stripes_[count_].bounds = {rect.left, bottom, rect.left + rect.width, end};
        stripes_[count_].facets.clear();
        rows_[row].push_back(int(count_++));
        bottom = end;
    }
}

void StripeLists::list_facet(const VisibleFacet& visible) {
    const Bounds& box = visible.box;
    for (int row = box.bottom / raster::kStripeRows; row * raster::kStripeRows < box.top; ++row) {
        for (const int stripe : rows_[row]) {
            const Bounds& within = stripes_[stripe].bounds;
            if (box.left < within.right && box.right > within.left)
                stripes_[stripe].facets.push_back(visible.facet);
        }
    }
}

}  // namespace viaface
