// Pixels in which more than one surface may be seen, so that they take several samples: those near an outline
// of the skin, that is an edge whose other triangle is missing or turned away, and all that facets may cover
// which are fine throughout: those of other materials and of the lips, which run into each other.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "synth/picture/raster_scene.hpp"
#include "synth/picture/stripe_lists.hpp"

namespace viaface {

class FinePixels {
  public:
    // `weld` gives for each node the one that stands for all at its place.
    FinePixels(std::span<const raster::Facet> facets, std::span<const int> weld, int width, int height);

    void find(const Visible& visible);  // of the facets given at first, where something is drawn

    // [height x words], a bit for each pixel, the lowest first; one word is over in each row.
    const std::vector<std::uint64_t>& bits() const { return bits_; }
    int words() const { return words_; }

  private:
    static constexpr int kNone = -1;
    struct Edge {
        int from, to;               // nodes of the first facet
        std::array<int, 2> facets;  // the second may be kNone
    };

    void mark_outline(const raster::Place& a, const raster::Place& b, const raster::Bounds& drawn);
    void mark(const raster::Bounds& box);  // within the picture

    std::vector<Edge> edges_;
    std::vector<int> covering_;  // facets that are fine throughout
    int words_;
    std::vector<std::uint64_t> bits_;
};

}  // namespace viaface
