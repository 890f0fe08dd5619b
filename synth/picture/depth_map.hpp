// What a parallel light sees of triangles: the one in front in each cell of a square map (L. Williams,
// "Casting curved shadows on curved surfaces", SIGGRAPH 1978).
#pragma once

#include <vector>

#include "synth/picture/surface_frame.hpp"

namespace viaface {

class DepthMap {
  public:
    // towards: unit, head frame, the way to the light. side: cells.
    DepthMap(const NodesF& places, const std::vector<Triangle>& casters, const Eigen::Vector3f& towards,
             int side);

    // bias: mm in front of itself that a surface does not shade. Outside the map all is lit.
    bool lit(const Eigen::Vector3f& place, float bias) const;

  private:
    Eigen::Vector3f project(const Eigen::Vector3f& place) const;
    void cast(const Eigen::Vector3f& a, const Eigen::Vector3f& b, const Eigen::Vector3f& c);

    int side_;
    Eigen::Matrix3f axes_;
    std::vector<float> depth_;  // [side x side], mm
};

// `count` unit ways spread evenly over the sphere on a spiral, the first up, the last down.
Eigen::Vector3f spiral_way(int index, int count);

}  // namespace viaface
