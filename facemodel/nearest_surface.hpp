// The nearest place on a triangle surface, by a tree of boxes; factored once, asked from any thread.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <vector>

#include "facemodel/mesh.hpp"

namespace viaface {

struct SurfacePlace {
    int triangle = -1;
    Eigen::Vector3d shares = Eigen::Vector3d::Zero();  // of the triangle's nodes, sum 1
    Eigen::Vector3d place = Eigen::Vector3d::Zero();
    double distance = 0;
};

class NearestSurface {
  public:
    // Copies nothing: `nodes` and `triangles` outlive this. std::invalid_argument for no triangle.
    NearestSurface(const Nodes& nodes, const std::vector<Triangle>& triangles);

    // within: the nearest place is known to be so near; triangle -1 when it is not.
    SurfacePlace operator()(const Eigen::Vector3d& place, double within = 1e150) const;

    Eigen::Vector3d normal(const SurfacePlace& at) const;  // unit, mixed from the nodes' normals
    bool on_border(const SurfacePlace& at) const;          // where the surface ends

  private:
    struct Box {
        Eigen::AlignedBox3d bounds;
        int first = 0, count = 0;  // of order_, where count > 0: a leaf
        int right = -1;            // the left child follows its parent
    };
    int build(int first, int count);
    void search(int box, const Eigen::Vector3d& place, SurfacePlace& best) const;

    const Nodes& nodes_;
    const std::vector<Triangle>& triangles_;
    std::vector<int> order_;
    std::vector<Box> boxes_;
    Nodes normals_;
    std::vector<std::array<bool, 3>> border_;  // [triangles]: of the edge opposite corner k
    std::vector<bool> border_nodes_;
};

// The nearest place of one triangle: shares of a, b, c. [Ericson, Real-Time Collision Detection, 5.1.5]
Eigen::Vector3d nearest_shares(const Eigen::Vector3d& place, const Eigen::Vector3d& a,
                               const Eigen::Vector3d& b, const Eigen::Vector3d& c);

// Sums over the adjoining triangles, weighted by area; unit. [nodes x 3]
Nodes node_normals(const Nodes& nodes, const std::vector<Triangle>& triangles);

}  // namespace viaface
