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

// False if it is turned away by more than the rounding of its corners could turn it.
bool faces_camera(const Eigen::Vector2f& a, const Eigen::Vector2f& b, const Eigen::Vector2f& c) {
    constexpr float kRounding = 1.0f / 64;  // pixels
    const Eigen::Vector2f to_b = b - a, to_c = c - a;
    const float reach = to_b.lpNorm<1>() + to_c.lpNorm<1>();
    return to_b.x() * to_c.y() - to_c.x() * to_b.y() > -kRounding * (reach + kRounding);
}

}  // namespace

MouthView::MouthView(const Face& face, int width, int height)
    : whole_{0, 0, width, height},
      opening_(whole_),
      kept_opening_(whole_),
      inner_contour_(inner_contour(face)),
      shown_(face.rest.rows(), 1),
      kept_shown_(face.rest.rows(), 1) {
    std::vector<Triangle> all;
    for (const auto& [material, triangles] : layers_of(face)) {
        if (!inside_mouth(material)) continue;
        all.insert(all.end(), triangles.begin(), triangles.end());
        for (const Triangle& t : triangles) inside_.push_back({t, two_sided(material), true});
    }
    inside_nodes_ = nodes_of(all);
}

void MouthView::look(std::span<const Eigen::Vector2f> pixels, std::span<const Extent> swept) {
    kept_opening_ = opening_;
    opening_ = inner_contour_.empty() ? whole_ : box_of(inner_contour_, pixels, whole_);
    shown_.swap(kept_shown_);
    for (const int node : inside_nodes_) shown_[node] = 0;
    triangles_.clear();
    nodes_.clear();
    const Extent through = swept_opening();
    for (auto& [t, two_sided, faced] : inside_) {
        const bool faces = two_sided || faces_camera(pixels[t[0]], pixels[t[1]], pixels[t[2]]);
        const bool may_show =
            (faces || faced) && touch(extent_of(swept[t[0]], swept[t[1]], swept[t[2]]), through);
        if (may_show) show(t);
        faced = faces;
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
