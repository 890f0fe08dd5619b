// The facets that may show where something is drawn, and where each of them may.
#pragma once

#include <span>
#include <vector>

#include "synth/picture/raster_scene.hpp"

namespace viaface {

struct VisibleFacet {
    raster::Bounds box;  // not empty
    std::uint32_t facet;
    bool fine;  // as in raster::Facet
};

// In drawing order, in pieces.
using VisibleFacets = std::span<const std::vector<VisibleFacet>>;

// What is known of the picture's facets, [facets].
struct Sight {
    std::span<const raster::Facet> facets;
    std::span<const raster::Bounds> boxes;
    std::span<const std::uint8_t> seen;  // as in raster::Triangles
    raster::Bounds opening;              // what is inside the mouth shows nowhere else
    raster::Bounds drawn;                // holds all that is drawn again
};

// Of the facets from `first` to `end`.
void find_visible(const Sight& sight, int first, int end, std::vector<VisibleFacet>& visible);

}  // namespace viaface
