// A face's nodes as the rasteriser takes them, and what each of its triangles is.
#pragma once

#include <vector>

#include "synth/picture/posed_vertices.hpp"
#include "synth/picture/raster_scene.hpp"
#include "synth/picture/view.hpp"
#include "synth/picture/work_pool.hpp"

namespace viaface {

// In the order in which they are drawn, filled up to a multiple of kFacetsAtOnce by facets that are never
// seen.
std::vector<raster::Facet> facets_of(const Face& face);

class RasterNodes {
  public:
    RasterNodes(const Face& face, const View& view, const raster::Kernel& kernel);

    // With `again`, nodes that `posed` calls unchanged stay.
    void place(const PosedVertices& posed, bool again, WorkPool& pool);
    const std::vector<raster::Node>& nodes() const { return nodes_; }

  private:
    const raster::Kernel& kernel_;
    const raster::Placing of_view_;   // what the view alone tells
    std::vector<std::uint8_t> lash_;  // of each node: 1 where it is a lash's
    Tangents tangents_;
    std::vector<raster::Node> nodes_;
};

}  // namespace viaface
