// What shows of the mouth's inside, which is seen through the opening between the inner lips alone: what is
// hidden needs neither light nor normals.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "facemodel/face.hpp"
#include "synth/picture/changed_bands.hpp"

namespace viaface {

class MouthView {
  public:
    MouthView(const Face& face, int width, int height);

    // [nodes]: where they are in this pose, and in this one and the one before, for which this was called
    // last.
    void look(std::span<const Eigen::Vector2f> pixels, std::span<const Extent> swept);

    // The box of the inner lip contour; all of the picture for a face without lips.
    const Rect& opening() const { return opening_; }
    Extent swept_opening() const { return both(Extent::of(opening_), Extent::of(kept_opening_)); }
    bool opening_changed() const { return opening_ != kept_opening_; }  // since the pose before

    // What may show, now or in the pose before.
    std::span<const Triangle> triangles() const { return triangles_; }
    std::span<const int> nodes() const { return nodes_; }

    // Of any node: none of its triangles may show. Outside the mouth nothing is hidden.
    bool hidden(int node) const { return shown_[node] == 0; }
    bool uncovered(int node) const { return shown_[node] != 0 && kept_shown_[node] == 0; }

  private:
    struct Inside {
        Triangle corners;
        bool two_sided, faced;  // faced the camera in the pose before
    };

    void show(const Triangle& triangle);

    Rect whole_, opening_, kept_opening_;
    std::vector<int> inner_contour_;  // nodes; none without lips
    std::vector<Inside> inside_;      // all there are
    std::vector<int> inside_nodes_;
    std::vector<Triangle> triangles_;
    std::vector<int> nodes_;
    std::vector<std::uint8_t> shown_, kept_shown_;  // of each node
};

}  // namespace viaface
