// The mesh as lines, as the report's figures show it: where two triangles make a quad its diagonal is left
// out, and so is what lies behind the surface. [ATR98, Figure 3] Departure: the mesh is the one that is
// drawn, finer than the report's; of the lips every other column and each third row is shown.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>

#include "synth/picture/background.hpp"
#include "synth/picture/layers.hpp"
#include "synth/picture/painter.hpp"
#include "synth/picture/strokes.hpp"

namespace viaface {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

constexpr Rgb kInk{20, 20, 24};
constexpr float kHalfWidth = 0.4f;  // pixels
constexpr float kBefore = 2.0f;     // mm: lines lie before the surface
constexpr int kLipColumns = 2, kLipRows = 3;

struct Line {
    int a, b;
    std::vector<int> triangles;  // on either side
};

std::vector<Triangle> solid_triangles(const Face& face) {
    std::vector<Triangle> all;
    for (const auto& [material, triangles] : layers_of(face)) {
        if (material != Material::kLash) all.insert(all.end(), triangles.begin(), triangles.end());
    }
    return all;
}

std::array<double, 3> sides_of(const Nodes& rest, const Triangle& t) {
    return {(rest.row(t[1]) - rest.row(t[0])).norm(), (rest.row(t[2]) - rest.row(t[1])).norm(),
            (rest.row(t[0]) - rest.row(t[2])).norm()};
}

bool lip_line(const LipGrid& lips, int a, int b) {
    const int i = a - lips.first_node, j = b - lips.first_node;
    const bool row = i / LipGrid::kColumns == j / LipGrid::kColumns;
    const bool column = i % LipGrid::kColumns == j % LipGrid::kColumns;
    return (row && i / LipGrid::kColumns % kLipRows == 0) ||
           (column && i % LipGrid::kColumns % kLipColumns == 0);
}

// Lines of skin, lips and cloth, each once, without diagonals.
std::vector<Line> lines_of(const Face& face, const std::vector<Triangle>& triangles) {
    struct Side {
        std::vector<int> triangles;
        bool diagonal = true;
    };
    std::map<std::pair<int, int>, Side> sides;
    std::vector<Material> materials(face.rest.rows(), Material::kMouth);
    for (const FacePart& part : face.parts)
        std::fill_n(materials.begin() + part.first_node, part.nodes, part.material);
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        const Triangle& t = triangles[i];
        const Material material = materials[t[0]];
        if (inside_mouth(material) || material == Material::kEye) continue;
        const auto lengths = sides_of(face.rest, t);
        const auto longest = std::ranges::max_element(lengths) - lengths.begin();
        for (int k = 0; k < 3; ++k) {
            Side& side = sides[std::minmax(face.weld[t[k]], face.weld[t[(k + 1) % 3]])];
            side.triangles.push_back(static_cast<int>(i));
            side.diagonal &=
                material == Material::kLips ? !lip_line(face.lips, t[k], t[(k + 1) % 3]) : k == longest;
        }
    }
    std::vector<Line> lines;
    for (const auto& [nodes, side] : sides) {
        if (!side.diagonal || side.triangles.size() == 1)
            lines.push_back({nodes.first, nodes.second, side.triangles});
    }
    return lines;
}

class WirePainter : public Painter {
  public:
    WirePainter(const Face& face, const View& view)
        : view_(view),
          camera_(camera_of(view)),
          triangles_(solid_triangles(face)),
          lines_(lines_of(face, triangles_)),
          background_(make_background(view).pixels),
          depths_(std::size_t(view.width) * view.height) {}

    // The whole picture, whatever the rectangles are.
    void paint(const PosedVertices& posed, std::span<const Rect> rects, bool, std::uint8_t* rgba) override {
        if (rects.empty()) return;
        place(posed);
        std::ranges::fill(depths_, 1.0f);
        faces_.assign(triangles_.size(), false);
        for (std::size_t i = 0; i < triangles_.size(); ++i) faces_[i] = cover(triangles_[i]);
        std::ranges::copy(background_, rgba);
        cover_.assign(depths_.size(), 0);
        const Canvas canvas{view_.width, view_.height, rgba};
        for (const Line& line : lines_) {
            if (std::ranges::any_of(line.triangles, [&](int t) { return faces_[t]; })) draw(canvas, line);
        }
        for (int y = 0; y < view_.height; ++y) {
            for (int x = 0; x < view_.width; ++x)
                canvas.lay(x, y, kInk, cover_[std::size_t(y) * view_.width + x]);
        }
    }

  private:
    void place(const PosedVertices& posed) {
        const auto vertices = posed.vertices();
        solid_.resize(vertices.size());
        raised_.resize(vertices.size());
        for (std::size_t i = 0; i < vertices.size(); ++i) {
            const Eigen::Vector3d head = Vector3f(vertices[i].place).cast<double>();
            const Eigen::Vector3d world = (camera_.world_from_head * head.homogeneous()).head<3>();
            solid_[i] = in_picture(world);
            raised_[i] = in_picture(world + kBefore * (camera_.place - world).normalized());
        }
    }

    // Pixels from the lower left corner, and the depth, which is linear in the picture.
    Vector3f in_picture(const Eigen::Vector3d& world) const {
        const Eigen::Vector4d clip = camera_.clip_from_world * world.homogeneous();
        if (clip.w() <= 0) return Vector3f::Constant(NAN);
        const Eigen::Vector3d p = clip.head<3>() / clip.w();
        return {float((p.x() + 1) / 2 * view_.width), float((p.y() + 1) / 2 * view_.height), float(p.z())};
    }

    // Whether the triangle faces the camera.
    bool cover(const Triangle& t) {
        const Vector3f &a = solid_[t[0]], &b = solid_[t[1]], &c = solid_[t[2]];
        const float area = (b.x() - a.x()) * (c.y() - a.y()) - (c.x() - a.x()) * (b.y() - a.y());
        if (!(area > 0)) return false;
        const auto first = [](float v, int size) {
            return int(std::clamp(std::ceil(v - 0.5f), 0.0f, float(size)));
        };
        const Vector3f low = a.cwiseMin(b).cwiseMin(c), high = a.cwiseMax(b).cwiseMax(c);
        const int right = first(high.x(), view_.width), top = first(high.y(), view_.height);
        for (int y = first(low.y(), view_.height); y < top; ++y) {
            for (int x = first(low.x(), view_.width); x < right; ++x) {
                const float px = x + 0.5f - a.x(), py = y + 0.5f - a.y();
                const float s = (px * (c.y() - a.y()) - py * (c.x() - a.x())) / area;
                const float u = ((b.x() - a.x()) * py - (b.y() - a.y()) * px) / area;
                if (s < 0 || u < 0 || s + u > 1) continue;
                float& depth = depths_[std::size_t(y) * view_.width + x];
                depth = std::min(depth, a.z() + s * (b.z() - a.z()) + u * (c.z() - a.z()));
            }
        }
        return true;
    }

    void draw(const Canvas& canvas, const Line& line) {
        const Vector3f &a = raised_[line.a], &b = raised_[line.b];
        if (!a.allFinite() || !b.allFinite()) return;
        for_pixels_near(canvas, a.head<2>(), b.head<2>(), kHalfWidth + 0.5f,
                        [&](int x, int y, float distance, float along) {
                            const std::size_t pixel = std::size_t(y) * view_.width + x;
                            if (a.z() + along * (b.z() - a.z()) > depths_[pixel]) return;
                            cover_[pixel] =
                                std::max(cover_[pixel], std::min(1.0f, kHalfWidth + 0.5f - distance));
                        });
    }

    View view_;
    Camera camera_;
    std::vector<Triangle> triangles_;
    std::vector<Line> lines_;
    std::vector<std::uint8_t> background_;
    std::vector<Vector3f> solid_, raised_;
    std::vector<float> depths_, cover_;  // of each pixel
    std::vector<bool> faces_;            // of each triangle
};

}  // namespace

std::unique_ptr<Painter> make_wire_painter(const Face& face, const View& view) {
    return std::make_unique<WirePainter>(face, view);
}

}  // namespace viaface
