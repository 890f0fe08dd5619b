#include "synth/picture/mouth_view.hpp"

#include "synth/picture/layers.hpp"

namespace viaface {
namespace {

std::vector<int> inner_contour(const Face& face) {
    std::vector<int> nodes;
    if (triangles_of(face, Material::kLips).empty()) return nodes;
    for (int c = 0; c < LipGrid::kColumns; ++c) nodes.push_back(face.lips.node(LipGrid::kRows - 1, c));
    return nodes;
}

}  // namespace

MouthView::MouthView(const Face& face, int width, int height)
    : whole_{0, 0, width, height},
      opening_(whole_),
      kept_opening_(whole_),
      inner_contour_(inner_contour(face)),
      shown_(face.rest.rows(), 1),
      kept_shown_(face.rest.rows(), 1) {
    for (const FacePart& part : face.parts) {
        if (!inside_mouth(part.material)) continue;
        inside_.insert(inside_.end(), part.triangles.begin(), part.triangles.end());
    }
    inside_nodes_ = nodes_of(inside_);
}

void MouthView::look(std::span<const Eigen::Vector2f> pixels, std::span<const Extent> swept) {
    kept_opening_ = opening_;
    opening_ = inner_contour_.empty() ? whole_ : box_of(inner_contour_, pixels, whole_);
    shown_.swap(kept_shown_);
    for (const int node : inside_nodes_) shown_[node] = 0;
    triangles_.clear();
    nodes_.clear();
    const Extent through = swept_opening();
    for (const Triangle& t : inside_) {
        if (touch(extent_of(swept[t[0]], swept[t[1]], swept[t[2]]), through)) show(t);
    }
}

void MouthView::show(const Triangle& triangle) {
    triangles_.push_back(triangle);
    for (const int node : triangle) {
        if (shown_[node] == 0) nodes_.push_back(node);
        shown_[node] = 1;
    }
}

}  // namespace viaface
