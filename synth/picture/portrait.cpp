#include "synth/picture/portrait.hpp"

#include <algorithm>
#include <stdexcept>

#include "synth/picture/changed_bands.hpp"
#include "synth/picture/layers.hpp"
#include "synth/picture/level_of_detail.hpp"
#include "synth/picture/painter.hpp"
#include "synth/picture/shown_face.hpp"

namespace viaface {
namespace {

void check(const Face& face) {
    const Eigen::Index nodes = face.rest.rows();
    bool fits = face.uvs.rows() == nodes && Eigen::Index(face.weld.size()) == nodes;
    for (const FacePart& part : face.parts) {
        const int end = part.first_node + part.nodes;
        fits &= part.first_node >= 0 && end <= nodes;
        for (const Triangle& t : part.triangles) {
            fits &= std::ranges::all_of(t, [&](int node) { return node >= part.first_node && node < end; });
        }
    }
    for (const int node : face.weld) fits &= node >= 0 && node < nodes;
    if (!fits) throw std::invalid_argument("a face whose parts, uvs or welds do not fit its nodes");
}

std::unique_ptr<Painter> make_painter(const Face& face, const Surfaces& surfaces, const View& view,
                                      const Drawing& drawing, WorkPool& pool) {
    if (view.shown == Shown::kWireframe) return make_wire_painter(face, view);
    if (drawing.renderer == Renderer::kOsmesa) return make_gl_painter(face, surfaces, view);
    return make_raster_painter(face, surfaces, view, drawing.widest, pool);
}

std::vector<Triangle> outside_mouth(const Face& face) {
    std::vector<Triangle> outside;
    for (const auto& [material, triangles] : layers_of(face)) {
        if (!inside_mouth(material)) outside.insert(outside.end(), triangles.begin(), triangles.end());
    }
    return outside;
}

// In the detail that shows; all of it where the mesh itself is looked at.
std::vector<FacePart> parts_in_detail(const Face& face, const View& view, WorkPool& pool) {
    if (view.shown == Shown::kWireframe) return face.parts;
    return coarser_parts(face, coarseness_for(pixel_size(view)), pool);
}

// What is drawn of a face, but for its surfaces, which are large.
Face drawn_of(const Face& face, std::vector<FacePart> parts) {
    Face drawn;
    drawn.rest = face.rest;
    drawn.uvs = face.uvs;
    drawn.weld = face.weld;
    drawn.parts = std::move(parts);
    drawn.lips = face.lips;
    return drawn;
}

}  // namespace

class Portrait::Impl {
  public:
    Impl(const CutFace& shown, const View& view, const Drawing& drawing, std::unique_ptr<WorkPool> pool)
        : Impl(shown.face, shown.face.surfaces, view, drawing, std::move(pool)) {
        cut_ = shown.nodes;
    }

    Impl(const Face& face, const Surfaces& surfaces, const View& view, const Drawing& drawing,
         std::unique_ptr<WorkPool> pool)
        : view_(view),
          pool_(std::move(pool)),
          painter_(make_painter(face, surfaces, view, drawing, *pool_)),
          posed_(face, view),
          bands_(pool_->threads(), ChangedBands(view.width, view.height)),
          outside_mouth_(outside_mouth(face)),
          eyes_(view.eyes_occluded && seen_from_front(view) ? nodes_of(triangles_of(face, Material::kEye))
                                                            : std::vector<int>()),
          rgba_(std::size_t(4) * view.width * view.height) {}

    FrameView draw(const Nodes& posed, Redraw redraw) {
        cut_.empty() ? posed_.pose(posed, *pool_) : posed_.pose(with_cut(posed, cut_), *pool_);
        const bool all = redraw == Redraw::kAll || !drawn_;
        painter_->paint(posed_, all ? std::vector{whole()} : changed(), !all, rgba_.data());
        drawn_ = true;
        return bottom_up_view(view_.width, view_.height, eyes_.empty() ? rgba_.data() : occluded());
    }

  private:
    Rect whole() const { return {0, 0, view_.width, view_.height}; }

    static bool seen_from_front(const View& view) { return camera_of(view).world_from_head(2, 2) > 0; }

    // The picture with a black bar over the eyes.
    const std::uint8_t* occluded() {
        occluded_ = rgba_;
        const Rect bar = box_of(eyes_, posed_.pixels(), whole(), kBarMargin);
        for (int y = bar.bottom; y < bar.bottom + bar.height; ++y) {
            for (int x = bar.left; x < bar.left + bar.width; ++x)
                std::fill_n(&occluded_[4 * (std::size_t(y) * view_.width + x)], 3, std::uint8_t{0});
        }
        return occluded_.data();
    }

    std::vector<Rect> changed() {
        pool_->share_rows(int(outside_mouth_.size()), [&](int first, int end, int thread) {
            for (int i = first; i < end; ++i) {
                if (moved(outside_mouth_[i])) bands_[thread].mark(swept(outside_mouth_[i]));
            }
        });
        for (std::size_t i = 1; i < bands_.size(); ++i) bands_[0].take_from(bands_[i]);
        const Extent opening = posed_.mouth().swept_opening();
        const auto moved_inside = [&](const Triangle& t) { return moved(t); };
        if (posed_.mouth().opening_changed() || std::ranges::any_of(posed_.mouth().triangles(), moved_inside))
            bands_[0].mark(opening);
        return bands_[0].take();
    }

    bool moved(const Triangle& t) const {
        return posed_.changed(t[0]) || posed_.changed(t[1]) || posed_.changed(t[2]);
    }
    Extent swept(const Triangle& t) const {
        return extent_of(posed_.swept(t[0]), posed_.swept(t[1]), posed_.swept(t[2]));
    }

    static constexpr float kBarMargin = 0.25f;

    View view_;
    std::vector<CutNode> cut_;  // nodes of the drawn face after those that are posed
    std::unique_ptr<WorkPool> pool_;
    std::unique_ptr<Painter> painter_;
    PosedVertices posed_;
    std::vector<ChangedBands> bands_;  // of each thread
    std::vector<Triangle> outside_mouth_;
    std::vector<int> eyes_;  // nodes under the bar; none without one
    std::vector<std::uint8_t> occluded_;
    std::vector<std::uint8_t> rgba_;
    bool drawn_ = false;
};

Portrait::Portrait(const Face& face, const View& view, const Drawing& drawing) {
    check(view);
    check(face);
    auto pool = std::make_unique<WorkPool>(std::max(1, drawing.threads));
    std::vector<FacePart> parts = parts_in_detail(face, view, *pool);
    if (shows_all(view)) {
        impl_ = std::make_unique<Impl>(drawn_of(face, std::move(parts)), face.surfaces, view, drawing,
                                       std::move(pool));
        return;
    }
    Face seen = face;
    seen.parts = std::move(parts);
    impl_ = std::make_unique<Impl>(shown_face(std::move(seen), view), view, drawing, std::move(pool));
}
Portrait::~Portrait() = default;
Portrait::Portrait(Portrait&&) noexcept = default;
Portrait& Portrait::operator=(Portrait&&) noexcept = default;

FrameView Portrait::draw(const Nodes& posed, Redraw redraw) { return impl_->draw(posed, redraw); }

}  // namespace viaface
