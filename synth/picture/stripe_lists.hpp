// The stripes of the rectangles that are drawn again, each with the triangles that may show in it.
#pragma once

#include <span>
#include <vector>

#include "synth/picture/rect.hpp"
#include "synth/picture/visible_facets.hpp"

namespace viaface {

struct StripeList {
    raster::Bounds bounds;
    std::vector<std::uint32_t> facets;  // in drawing order
};

class StripeLists {
  public:
    explicit StripeLists(int height);  // of the picture, pixels

    void list(std::span<const Rect> rects, VisibleFacets visible);
    // Those of most facets first, so that threads that take them one by one end together.
    std::span<const StripeList> stripes() const { return {stripes_.data(), count_}; }

  private:
    void cut(const Rect& rect);
    void list_facet(const VisibleFacet& visible);

    std::vector<StripeList> stripes_;  // the first count_ are in use
    std::size_t count_ = 0;
    std::vector<std::vector<int>> rows_;  // the stripes of each row of stripes
};

}  // namespace viaface
