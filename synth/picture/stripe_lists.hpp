// The stripes of the rectangles that are drawn again, each with the triangles that may show in it.
#pragma once

#include <span>
#include <vector>

#include "synth/picture/raster_scene.hpp"
#include "synth/picture/rect.hpp"

namespace viaface {

struct StripeList {
    raster::Bounds bounds;
    std::vector<std::uint32_t> facets;  // in drawing order
};

// What may show of the picture's triangles.
struct Visible {
    std::span<const raster::Facet> facets;
    std::span<const raster::Node> nodes;
    std::span<const raster::Bounds> boxes;  // of each facet
    std::span<const std::uint8_t> seen;     // of each facet
    raster::Bounds opening;                 // what is inside the mouth shows nowhere else
    raster::Bounds drawn;                   // holds all that is drawn again
};

// Where a facet may show among what is drawn; empty where it does not.
inline raster::Bounds box_of(const Visible& visible, int facet) {
    const raster::Bounds box = raster::common(visible.boxes[facet], visible.drawn);
    return visible.facets[facet].inside ? raster::common(box, visible.opening) : box;
}

class StripeLists {
  public:
    explicit StripeLists(int height);  // of the picture, pixels

    void list(std::span<const Rect> rects, const Visible& visible);
    // Those of most facets first, so that threads that take them one by one end together.
    std::span<const StripeList> stripes() const { return {stripes_.data(), count_}; }

  private:
    void cut(const Rect& rect);
    void list_facets(const Visible& visible);

    std::vector<StripeList> stripes_;  // the first count_ are in use
    std::size_t count_ = 0;
    std::vector<std::vector<int>> rows_;  // the stripes of each row of stripes
};

}  // namespace viaface
