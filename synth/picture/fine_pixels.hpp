// Pixels in which more than one surface may be seen, so that they take several samples: those near an outline
// of the skin, that is an edge whose other triangle is missing or turned away, and all that facets may cover
// which are fine throughout: those of other materials and of the lips, which run into each other.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "synth/picture/raster_scene.hpp"
#include "synth/picture/visible_facets.hpp"
#include "synth/picture/work_pool.hpp"

namespace viaface {

class FinePixels {
  public:
    // `weld` gives for each node the one that stands for all at its place.
    FinePixels(std::span<const raster::Facet> facets, std::span<const int> weld, int width, int height);

    // First, by several threads, which edges are outlines; `seen` is of the facets given at first.
    void find_outlines(std::span<const std::uint8_t> seen, WorkPool& pool);
    // Then the pixels, where something is drawn.
    void mark(std::span<const raster::Node> nodes, VisibleFacets visible, const raster::Bounds& drawn);

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
    std::vector<std::vector<int>> outlines_;  // edges, piece by piece
    int words_;
    std::vector<std::uint64_t> bits_;
};

}  // namespace viaface
