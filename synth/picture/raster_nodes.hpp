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
    RasterNodes(const Face& face, const View& view);

    // With `again`, nodes that `posed` calls unchanged stay, and what is hidden gets its place alone.
    void place(const PosedVertices& posed, bool again, WorkPool& pool);
    const std::vector<raster::Node>& nodes() const { return nodes_; }

  private:
    void place(const Vertex& vertex, int node);
    void light(const Vertex& vertex, int node);
    raster::Place place_of(const Eigen::Vector4f& clip, float height) const;

    bool orthographic_;
    Eigen::Vector2f half_picture_;  // pixels
    float far_;                     // 1 / distance of the camera, 1/mm
    Eigen::Matrix4f world_from_head_, clip_from_world_;
    Eigen::Vector3f eye_;
    std::vector<std::uint8_t> lash_;  // of each node: 1 where it is a lash's
    Tangents tangents_;
    std::vector<raster::Node> nodes_;
};

}  // namespace viaface
