// The vertices of a pose as the graphics library takes them, and where each falls in the picture.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "synth/picture/mouth_light.hpp"
#include "synth/picture/mouth_view.hpp"
#include "synth/picture/surface_frame.hpp"
#include "synth/picture/view.hpp"

namespace viaface {

struct Vertex {
    float place[3];   // mm, head frame
    float normal[3];  // unit
    float light;      // share of the outside light that gets here, 0 to 1
    float key;        // share of the key light, 0 to 1
    bool operator==(const Vertex&) const = default;
};

class PosedVertices {
  public:
    PosedVertices(const Face& face, const View& view);

    void pose(const Nodes& posed, WorkPool& pool);
    // Of what is hidden inside the mouth places are right, normals and light may be of an earlier pose.
    std::span<const Vertex> vertices() const { return vertices_; }
    std::span<const Eigen::Vector2f> pixels() const { return pixels_; }  // from the lower left corner
    const Eigen::Vector2f& pixel(int node) const { return pixels_[node]; }
    const MouthView& mouth() const { return mouth_; }

    bool changed(int node) const { return changed_[node] != 0; }  // since the pose before
    const Extent& swept(int node) const { return swept_[node]; }  // where it is and was in the pose before

  private:
    void place(const Nodes& posed, int node);
    void turn(int node);
    void finish(int node);
    Eigen::Vector2f in_picture(int node) const;

    std::vector<int> nodes_;  // that are corners of triangles: all others stay as they are
    Nodes rest_;
    Eigen::VectorXd least_ways_;  // mm
    NodeNormals node_normals_;
    MouthView mouth_;
    MouthLight mouth_light_;
    Eigen::Matrix4f clip_from_head_;
    Eigen::Vector2f half_picture_;
    NodesF standing_, places_;
    std::vector<std::uint8_t> moved_;   // of each node: 1 where its place is another than in the pose before
    std::vector<std::uint8_t> turned_;  // of each node: 1 where its normal was worked out again
    NodesF normals_;
    std::vector<float> light_, key_;
    std::vector<Vertex> vertices_;
    std::vector<std::uint8_t> changed_;  // of each node
    std::vector<Eigen::Vector2f> pixels_;
    std::vector<Extent> swept_;
};

}  // namespace viaface
