#include "synth/picture/portrait.hpp"

#include <algorithm>
#include <optional>
#include <stdexcept>

#include "synth/picture/changed_bands.hpp"
#include "synth/picture/gl.hpp"
#include "synth/picture/gl_context.hpp"
#include "synth/picture/posed_vertices.hpp"
#include "synth/picture/shading.hpp"

namespace viaface {
namespace {

// Lashes are laid over all else; within the rest what is in front comes first.
constexpr Material kDrawOrder[] = {Material::kSkin,   Material::kLips,  Material::kCloth,
                                   Material::kEye,    Material::kTeeth, Material::kGums,
                                   Material::kTongue, Material::kMouth, Material::kLash};

void check(const Face& face) {
    const Eigen::Index nodes = face.rest.rows();
    bool fits = face.uvs.rows() == nodes && Eigen::Index(face.weld.size()) == nodes;
    for (const FacePart& part : face.parts) {
        for (const Triangle& t : part.triangles) {
            fits &= std::ranges::all_of(t, [&](int node) { return node >= 0 && node < nodes; });
        }
    }
    for (const int node : face.weld) fits &= node >= 0 && node < nodes;
    if (!fits) throw std::invalid_argument("a face whose parts, uvs or welds do not fit its nodes");
}

template <class T>
void fill_buffer(GLuint buffer, const T* data, std::size_t count, GLenum usage) {
    glBindBuffer(GL_ARRAY_BUFFER, buffer);
    glBufferData(GL_ARRAY_BUFFER, GLsizeiptr(count * sizeof(T)), data, usage);
}

void attribute(GLuint index, int size, int stride, std::size_t offset) {
    glVertexAttribPointer(index, size, GL_FLOAT, GL_FALSE, stride, reinterpret_cast<const void*>(offset));
    glEnableVertexAttribArray(index);
}

struct Uploaded {
    GLuint vertices, indices;
};

// One vertex array: attributes 0 to 2 of the pose, 3 and 4 that never change.
Uploaded upload(const Face& face) {
    GLuint array = 0;
    glGenVertexArrays(1, &array);
    glBindVertexArray(array);
    const Uploaded uploaded{make_buffer(), make_buffer()};
    glBindBuffer(GL_ARRAY_BUFFER, uploaded.vertices);
    attribute(kPlaceAttribute, 3, sizeof(Vertex), offsetof(Vertex, place));
    attribute(kNormalAttribute, 3, sizeof(Vertex), offsetof(Vertex, normal));
    attribute(kLightAttribute, 1, sizeof(Vertex), offsetof(Vertex, light));
    fill_buffer(make_buffer(), face.uvs.data(), face.uvs.size(), GL_STATIC_DRAW);
    attribute(kUvAttribute, 2, 2 * sizeof(float), 0);
    const NodesF rest = face.rest.cast<float>();
    NodesF normals;
    NodeNormals(face).compute(rest, normals);
    const Tangents tangents = rest_tangents(face, normals);
    fill_buffer(make_buffer(), tangents.data(), tangents.size(), GL_STATIC_DRAW);
    attribute(kTangentAttribute, 4, 4 * sizeof(float), 0);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, uploaded.indices);
    return uploaded;
}

std::vector<Triangle> triangles_of(const Face& face, Material material) {
    std::vector<Triangle> triangles;
    for (const FacePart& part : face.parts) {
        if (part.material != material) continue;
        triangles.insert(triangles.end(), part.triangles.begin(), part.triangles.end());
    }
    return triangles;
}

bool inside_mouth(Material m) { return m >= Material::kMouth && m <= Material::kTongue; }

std::vector<int> inner_contour(const Face& face) {
    std::vector<int> nodes;
    if (triangles_of(face, Material::kLips).empty()) return nodes;
    for (int c = 0; c < LipGrid::kColumns; ++c) nodes.push_back(face.lips.node(LipGrid::kRows - 1, c));
    return nodes;
}

void scissor(const Rect& rect) { glScissor(rect.left, rect.bottom, rect.width, rect.height); }

}  // namespace

class Portrait::Impl {
  public:
    Impl(const Face& face, const View& view)
        : view_(view),
          camera_(camera_of(view)),
          context_(make_osmesa_context()),
          picture_(view.width, view.height),
          shading_(face, view, camera_),
          posed_(face, view, camera_.clip_from_world * camera_.world_from_head),
          bands_(view.width, view.height),
          buffers_(upload(face)),
          rgba_(std::size_t(4) * view.width * view.height) {
        for (const Material material : kDrawOrder)
            layers_.push_back({material, inside_mouth(material), triangles_of(face, material)});
        inner_contour_ = inner_contour(face);
        check_gl("uploading a face");
    }

    FrameView draw(const Nodes& posed, Redraw redraw) {
        context_->make_current();
        posed_.pose(posed);
        const Rect mouth = opening();
        const bool all = redraw == Redraw::kAll || !drawn_;
        const std::vector<Rect> rects = all ? std::vector{whole()} : changed(mouth);
        if (!rects.empty()) draw(rects, mouth);
        kept_opening_ = mouth;
        drawn_ = true;
        posed_.keep();
        return bottom_up_view(view_.width, view_.height, rgba_.data());
    }

  private:
    struct Layer {
        Material material;
        bool inside;  // seen through the opening of the mouth alone
        std::vector<Triangle> triangles;
    };
    struct Batch {
        Material material;
        Rect seen;
        std::size_t first, count;  // indices
    };

    Rect whole() const { return {0, 0, view_.width, view_.height}; }

    // The box of the inner contour in the picture: nothing inside the mouth is drawn outside it.
    Rect opening() const {
        if (inner_contour_.empty()) return whole();
        Eigen::Vector2f low = posed_.pixel(inner_contour_.front()), high = low;
        for (const int node : inner_contour_) {
            low = low.cwiseMin(posed_.pixel(node));
            high = high.cwiseMax(posed_.pixel(node));
        }
        const Eigen::Vector2i from = low.cast<int>().array() - 1, to = high.cast<int>().array() + 2;
        return common(whole(), {from.x(), from.y(), to.x() - from.x(), to.y() - from.y()});
    }

    std::vector<Rect> changed(const Rect& opening) {
        const auto mark = [&](const Layer& layer, const Extent& extent, const Rect& seen_through) {
            if (!layer.inside) bands_.mark(extent);
            if (layer.inside && touches(extent, seen_through)) bands_.mark(within(extent, seen_through));
        };
        for (const Layer& layer : layers_) {
            for (const auto& [a, b, c] : layer.triangles) {
                if (!posed_.changed(a) && !posed_.changed(b) && !posed_.changed(c)) continue;
                mark(layer, extent_of(posed_.pixel(a), posed_.pixel(b), posed_.pixel(c)), opening);
                mark(layer, extent_of(posed_.kept_pixel(a), posed_.kept_pixel(b), posed_.kept_pixel(c)),
                     kept_opening_);
            }
        }
        if (opening != kept_opening_) {
            bands_.mark(extent_of(opening));
            bands_.mark(extent_of(kept_opening_));
        }
        return bands_.take();
    }

    // Turned away by more than rounding can hide.
    bool turned_away(const Triangle& t) const {
        const Eigen::Vector2f e1 = posed_.pixel(t[1]) - posed_.pixel(t[0]),
                              e2 = posed_.pixel(t[2]) - posed_.pixel(t[0]);
        return e1.x() * e2.y() - e1.y() * e2.x() < -1;
    }

    // The triangles that may show in the rectangle, in the order they are always drawn.
    std::vector<Batch> gather(const Rect& rect, const Rect& opening) {
        std::vector<Batch> batches;
        for (const Layer& layer : layers_) {
            const std::size_t first = indices_.size();
            const Rect seen = layer.inside ? common(rect, opening) : rect;
            const bool culled = !two_sided(layer.material);
            if (seen.width == 0 || seen.height == 0) continue;
            for (const Triangle& t : layer.triangles) {
                if (!touches(extent_of(posed_.pixel(t[0]), posed_.pixel(t[1]), posed_.pixel(t[2])), seen))
                    continue;
                if (culled && turned_away(t)) continue;
                for (const int node : t) indices_.push_back(static_cast<GLuint>(node));
            }
            if (indices_.size() > first)
                batches.push_back({layer.material, seen, first, indices_.size() - first});
        }
        return batches;
    }

    void draw(const std::vector<Rect>& rects, const Rect& opening) {
        indices_.clear();
        std::vector<std::vector<Batch>> batches;
        for (const Rect& rect : rects) batches.push_back(gather(rect, opening));
        const auto vertices = posed_.vertices();
        fill_buffer(buffers_.vertices, vertices.data(), vertices.size(), GL_STREAM_DRAW);
        glBufferData(GL_ELEMENT_ARRAY_BUFFER, GLsizeiptr(indices_.size() * sizeof(GLuint)), indices_.data(),
                     GL_STREAM_DRAW);
        picture_.bind();
        for (std::size_t i = 0; i < rects.size(); ++i) draw(rects[i], batches[i]);
        for (const Rect& rect : rects) picture_.read(rect, rgba_.data());
    }

    void draw(const Rect& rect, const std::vector<Batch>& batches) {
        glEnable(GL_SCISSOR_TEST);
        scissor(rect);
        shading_.draw_background();
        for (const Batch& batch : batches) {
            scissor(batch.seen);
            shading_.begin(batch.material);
            glDrawElements(GL_TRIANGLES, GLsizei(batch.count), GL_UNSIGNED_INT,
                           reinterpret_cast<const void*>(batch.first * sizeof(GLuint)));
        }
        glDisable(GL_SCISSOR_TEST);
    }

    View view_;
    Camera camera_;
    std::unique_ptr<GlContext> context_;
    MultisampledPicture picture_;
    Shading shading_;
    PosedVertices posed_;
    ChangedBands bands_;
    Uploaded buffers_;
    std::vector<Layer> layers_;
    std::vector<int> inner_contour_;  // nodes; none without lips
    Rect kept_opening_;
    std::vector<GLuint> indices_;
    std::vector<std::uint8_t> rgba_;
    bool drawn_ = false;
};

Portrait::Portrait(const Face& face, const View& view) {
    check(view);
    check(face);
    impl_ = std::make_unique<Impl>(face, view);
}
Portrait::~Portrait() = default;
Portrait::Portrait(Portrait&&) noexcept = default;
Portrait& Portrait::operator=(Portrait&&) noexcept = default;

FrameView Portrait::draw(const Nodes& posed, Redraw redraw) { return impl_->draw(posed, redraw); }

}  // namespace viaface
