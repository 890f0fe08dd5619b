#include <utility>

#include "synth/picture/changed_bands.hpp"
#include "synth/picture/gl.hpp"
#include "synth/picture/gl_context.hpp"
#include "synth/picture/layers.hpp"
#include "synth/picture/painter.hpp"
#include "synth/picture/shading.hpp"

namespace viaface {
namespace {

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
    attribute(kLightAttribute, 2, sizeof(Vertex), offsetof(Vertex, light));
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

void scissor(const Rect& rect) { glScissor(rect.left, rect.bottom, rect.width, rect.height); }

class GlPainter : public Painter {
  public:
    GlPainter(const Face& face, const Surfaces& surfaces, const View& view)
        : context_(make_osmesa_context()),
          picture_(view.width, view.height),
          shading_(surfaces, view, camera_of(view)),
          layers_(layers_of(face)),
          buffers_(upload(face)) {
        check_gl("uploading a face");
    }

    void paint(const PosedVertices& posed, std::span<const Rect> rects, bool, std::uint8_t* rgba) override {
        if (rects.empty()) return;
        context_->make_current();
        indices_.clear();
        std::vector<std::vector<Batch>> batches;
        for (const Rect& rect : rects) batches.push_back(gather(posed, rect, posed.mouth().opening()));
        const auto vertices = posed.vertices();
        fill_buffer(buffers_.vertices, vertices.data(), vertices.size(), GL_STREAM_DRAW);
        glBufferData(GL_ELEMENT_ARRAY_BUFFER, GLsizeiptr(indices_.size() * sizeof(GLuint)), indices_.data(),
                     GL_STREAM_DRAW);
        // One by one: what is drawn within a scissor spoils samples of the row beyond it.
        for (std::size_t i = 0; i < rects.size(); ++i) {
            picture_.bind();
            draw(rects[i], batches[i]);
            picture_.read(rects[i], rgba);
        }
    }

  private:
    struct Batch {
        Material material;
        Rect seen;
        std::size_t first, count;  // indices
    };

    // Turned away by more than rounding can hide.
    static bool turned_away(const PosedVertices& posed, const Triangle& t) {
        const Eigen::Vector2f e1 = posed.pixel(t[1]) - posed.pixel(t[0]),
                              e2 = posed.pixel(t[2]) - posed.pixel(t[0]);
        return e1.x() * e2.y() - e1.y() * e2.x() < -1;
    }

    // The triangles that may show in the rectangle, in the order they are always drawn.
    std::vector<Batch> gather(const PosedVertices& posed, const Rect& rect, const Rect& opening) {
        std::vector<Batch> batches;
        for (const Layer& layer : layers_) {
            const std::size_t first = indices_.size();
            const Rect seen = inside_mouth(layer.material) ? common(rect, opening) : rect;
            const bool culled = !two_sided(layer.material);
            if (seen.width == 0 || seen.height == 0) continue;
            for (const Triangle& t : layer.triangles) {
                if (!touch(extent_of(posed.swept(t[0]), posed.swept(t[1]), posed.swept(t[2])),
                           Extent::of(seen)))
                    continue;
                if (culled && turned_away(posed, t)) continue;
                for (const int node : t) indices_.push_back(static_cast<GLuint>(node));
            }
            if (indices_.size() > first)
                batches.push_back({layer.material, seen, first, indices_.size() - first});
        }
        return batches;
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

    std::unique_ptr<GlContext> context_;
    MultisampledPicture picture_;
    Shading shading_;
    std::vector<Layer> layers_;
    Uploaded buffers_;
    std::vector<GLuint> indices_;
};

}  // namespace

std::unique_ptr<Painter> make_gl_painter(const Face& face, const Surfaces& surfaces, const View& view) {
    return std::make_unique<GlPainter>(face, surfaces, view);
}

}  // namespace viaface
