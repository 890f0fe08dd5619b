#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstring>

#include "synth/picture/background.hpp"
#include "synth/picture/fine_pixels.hpp"
#include "synth/picture/layers.hpp"
#include "synth/picture/painter.hpp"
#include "synth/picture/raster_scene.hpp"
#include "synth/picture/raster_textures.hpp"
#include "synth/picture/stripe_pool.hpp"

namespace viaface {
namespace {

using Eigen::Vector3f;
using raster::Bounds;

constexpr float kFold = 1.0f;   // slope, depth per width
constexpr float kStep = 0.75f;  // pixels

raster::Shade shade_of(Material material) {
    switch (material) {
        case Material::kSkin:
        case Material::kLips:
            return raster::Shade::kSkin;
        case Material::kMouth:
        case Material::kGums:
        case Material::kTeeth:
        case Material::kTongue:
            return raster::Shade::kInside;
        case Material::kEye:
            return raster::Shade::kEye;
        case Material::kLash:
            return raster::Shade::kLash;
        case Material::kCloth:
            return raster::Shade::kCloth;
    }
    return raster::Shade::kSkin;
}

std::vector<raster::Facet> facets_of(const Face& face) {
    std::vector<raster::Facet> facets;
    for (const auto& [material, triangles] : layers_of(face)) {
        for (const auto& [a, b, c] : triangles) {
            facets.push_back({{a, b, c},
                              static_cast<std::uint8_t>(material),
                              shade_of(material),
                              inside_mouth(material),
                              two_sided(material),
                              material != Material::kSkin});
        }
    }
    return facets;
}

raster::DrawStripe kernel_of(Instructions instructions) {
#ifdef VIAFACE_AVX2_KERNEL
    if (instructions == Instructions::kBest && __builtin_cpu_supports("avx2"))
        return raster::avx2::draw_stripe;
#endif
    static_cast<void>(instructions);
    return raster::baseline::draw_stripe;
}

struct FrontBuffers {
    std::vector<float> nearness;
    std::vector<std::int32_t> seen;

    explicit FrontBuffers(std::size_t places) : nearness(places), seen(places) {}
    raster::Front front() { return {nearness.data(), seen.data()}; }
};

// Buffers of one thread.
struct Workspace {
    FrontBuffers middles, samples;
    std::vector<std::uint32_t> sums;
    std::vector<raster::Fragment> mixed;
    std::vector<raster::Surface> surfaces;

    explicit Workspace(int width)
        : middles(std::size_t(width + raster::kPixelsBeyond) * raster::kStripeRows),
          samples(std::size_t(width + 1) * raster::kStripeRows * raster::kSamples),
          sums(std::size_t(width) * raster::kStripeRows),
          mixed(sums.size()) {}

    raster::Scratch scratch(std::size_t facets) {
        if (surfaces.size() < facets) surfaces.resize(facets);
        return {middles.front(), samples.front(), sums.data(), mixed.data(), surfaces.data()};
    }
};

struct StripeList {
    Bounds bounds;
    std::vector<std::uint32_t> facets;
};

class RasterPainter : public Painter {
  public:
    RasterPainter(const Face& face, const View& view, const Drawing& drawing)
        : width_(view.width),
          height_(view.height),
          camera_(camera_of(view)),
          far_(static_cast<float>(1 / camera_.place.z())),
          facets_(facets_of(face)),
          lash_(face.rest.rows(), false),
          placed_(face.rest.rows()),
          places_(face.rest.rows()),
          nodes_(face.rest.rows()),
          background_(std::size_t(view.width) * view.height),
          alone_(background_.size()),
          still_(facets_.size()),
          turned_to_us_(facets_.size()),
          fine_(facets_, face.weld, view.width, view.height),
          draw_stripe_(kernel_of(drawing.instructions)),
          pool_(std::max(1, drawing.threads)),
          rows_((view.height + raster::kStripeRows - 1) / raster::kStripeRows) {
        prepare_nodes(face);
        prepare_textures(face);
        const Texture background = make_background(view);
        std::memcpy(background_.data(), background.pixels.data(), background.pixels.size());
        workspaces_.assign(pool_.threads(), Workspace(view.width));
        prepare_scene(view);
    }

    void paint(const PosedVertices& posed, std::span<const Rect> rects, const Rect& opening, bool again,
               std::uint8_t* rgba) override {
        place(posed);
        for (std::size_t i = 0; i < facets_.size(); ++i) {
            const auto& [a, b, c] = facets_[i].node;
            still_[i] = again && !posed.changed(a) && !posed.changed(b) && !posed.changed(c);
        }
        raster::Scene scene = scene_;
        scene.rgba = reinterpret_cast<std::uint32_t*>(rgba);
        scene.opening = {opening.left, opening.bottom, opening.left + opening.width,
                         opening.bottom + opening.height};
        find_turned();
        fine_.find(places_, turned_to_us_, scene.opening);
        const int count = list_stripes(rects, scene.opening);
        pool_.share(count, [&](int item, int thread) {
            const StripeList& list = stripes_[item];
            const auto facets = static_cast<std::int32_t>(list.facets.size());
            draw_stripe_(scene, {list.bounds, list.facets.data(), facets},
                         workspaces_[thread].scratch(facets));
        });
    }

  private:
    void prepare_nodes(const Face& face) {
        for (const FacePart& part : face.parts) {
            if (part.material != Material::kLash) continue;
            for (const auto& triangle : part.triangles) {
                for (const int node : triangle) lash_[node] = true;
            }
        }
        NodesF normals;
        NodeNormals(face).compute(face.rest.cast<float>(), normals);
        tangents_ = rest_tangents(face, normals);
        for (std::size_t i = 0; i < nodes_.size(); ++i) {
            nodes_[i].s = face.uvs(i, 0);
            nodes_[i].t = 1 - face.uvs(i, 1);
            nodes_[i].side = tangents_(i, 3);
        }
    }

    void prepare_textures(const Face& face) {
        for (int i = 0; i < kMaterials; ++i) {
            textures_.emplace_back(pack(face.surfaces[i], static_cast<Material>(i)));
            mipmaps_.push_back(textures_.back().mipmap());
        }
    }

    void prepare_scene(const View& view) {
        scene_.places = places_.data();
        scene_.nodes = nodes_.data();
        scene_.facets = facets_.data();
        scene_.mipmaps = mipmaps_.data();
        scene_.background = background_.data();
        scene_.alone = alone_.data();
        scene_.still = still_.data();
        scene_.fine = fine_.bits().data();
        scene_.fine_words = fine_.words();
        scene_.width = width_;
        const auto share = static_cast<float>(pixel_size(view) / camera_.place.norm());
        scene_.fold = kFold * share;
        scene_.step = kStep * share;
        if (camera_.orthographic) {
            scene_.to_camera[0][2] = 1;
            return;
        }
        // A pixel's ray ends where clip x and y are its own and w = 1.
        const Eigen::Matrix3d clip_from_way = (Eigen::Matrix3d() << camera_.clip_from_world.block<2, 3>(0, 0),
                                               camera_.clip_from_world.block<1, 3>(3, 0))
                                                  .finished();
        const Eigen::Matrix3d way_from_clip = clip_from_way.inverse();
        const auto set = [&](int i, double x, double y, double w) {
            const Vector3f way = -(way_from_clip * Eigen::Vector3d(x, y, w)).cast<float>();
            std::copy(way.data(), way.data() + 3, scene_.to_camera[i]);
        };
        set(0, 1.0 / width_ - 1, 1.0 / height_ - 1, 1);
        set(1, 2.0 / width_, 0, 0);
        set(2, 0, 2.0 / height_, 0);
    }

    void place(const PosedVertices& posed) {
        const Eigen::Matrix4f world_from_head = camera_.world_from_head.cast<float>();
        const Eigen::Matrix4f clip_from_world = camera_.clip_from_world.cast<float>();
        const Eigen::Matrix3f turn = world_from_head.topLeftCorner<3, 3>();
        const Vector3f shift = world_from_head.topRightCorner<3, 1>(), eye = camera_.place.cast<float>();
        const auto vertices = posed.vertices();
        for (std::size_t i = 0; i < vertices.size(); ++i) {
            const Vertex& v = vertices[i];
            if (v == placed_[i]) continue;
            placed_[i] = v;
            Vector3f world = turn * Vector3f(v.place) + shift;
            if (lash_[i]) world += kLashesBefore * (eye - world).normalized();
            const Eigen::Vector4f clip = clip_from_world * world.homogeneous();
            places_[i] = place_of(clip, world.z());
            const Vector3f normal(v.normal), tangent = tangents_.row(i).head<3>().transpose();
            const Vector3f along = (tangent - normal * normal.dot(tangent)).normalized();
            Vector3f::Map(nodes_[i].normal) = turn * normal;
            Vector3f::Map(nodes_[i].tangent) = turn * along;
            nodes_[i].light = v.light;
            nodes_[i].key = v.key;
        }
    }

    raster::Place place_of(const Eigen::Vector4f& clip, float height) const {
        const float shrink = 1 / clip.w();
        const float near = camera_.orthographic ? (1 + height * far_) * far_ : shrink;
        const float x = clip.x() * shrink * 0.5f * width_, y = clip.y() * shrink * 0.5f * height_;
        const bool can = clip.w() > 0 && std::abs(clip.z()) <= clip.w() && std::abs(x) < raster::kGuard &&
                         std::abs(y) < raster::kGuard;
        if (!can) return {0, 0, 0};
        return {static_cast<std::int32_t>(std::lrint((x + 0.5f * width_) * raster::kSteps)),
                static_cast<std::int32_t>(std::lrint((y + 0.5f * height_) * raster::kSteps)), near};
    }

    // The stripes of the rectangles, each with what may show in it. How many there are.
    int list_stripes(std::span<const Rect> rects, const Bounds& opening) {
        int count = 0;
        for (std::vector<int>& row : rows_) row.clear();
        for (const Rect& rect : rects) {
            const int top = rect.bottom + rect.height;
            for (int bottom = rect.bottom; bottom < top;) {
                const int row = bottom / raster::kStripeRows;
                const int end = std::min(top, (row + 1) * raster::kStripeRows);
                if (int(stripes_.size()) == count) stripes_.emplace_back();
                stripes_[count].bounds = {rect.left, bottom, rect.left + rect.width, end};
                stripes_[count].facets.clear();
                rows_[row].push_back(count++);
                bottom = end;
            }
        }
        list_facets(opening);
        return count;
    }

    void list_facets(const Bounds& opening) {
        for (std::uint32_t i = 0; i < facets_.size(); ++i) {
            if (!turned_to_us_[i]) continue;
            const Bounds box = box_of(facets_[i], opening);
            const int first = std::max(0, box.bottom) / raster::kStripeRows;
            const int last = std::min(height_, box.top) - 1;
            for (int row = first; row * raster::kStripeRows <= last; ++row) {
                for (const int stripe : rows_[row]) {
                    const Bounds& seen = stripes_[stripe].bounds;
                    if (box.left < seen.right && box.right > seen.left) stripes_[stripe].facets.push_back(i);
                }
            }
        }
    }

    Bounds box_of(const raster::Facet& facet, const Bounds& opening) const {
        const auto& [a, b, c] = facet.node;
        const Bounds box = raster::box_of(places_[a], places_[b], places_[c]);
        return facet.inside ? raster::common(box, opening) : box;
    }

    void find_turned() {
        for (std::size_t i = 0; i < facets_.size(); ++i) {
            const raster::Place &a = places_[facets_[i].node[0]], &b = places_[facets_[i].node[1]],
                                &c = places_[facets_[i].node[2]];
            turned_to_us_[i] = a.nearness != 0 && b.nearness != 0 && c.nearness != 0 &&
                               (facets_[i].two_sided || !turned_away(a, b, c));
        }
    }

    static bool turned_away(const raster::Place& a, const raster::Place& b, const raster::Place& c) {
        return std::int64_t(b.x - a.x) * (c.y - a.y) - std::int64_t(b.y - a.y) * (c.x - a.x) <= 0;
    }

    int width_, height_;
    Camera camera_;
    float far_;  // 1 / distance of an orthographic camera, whose heights make up what is in front
    std::vector<raster::Facet> facets_;
    std::vector<bool> lash_;  // of each node
    Tangents tangents_;
    std::vector<Vertex> placed_;  // what places_ and nodes_ stand for
    std::vector<raster::Place> places_;
    std::vector<raster::Node> nodes_;
    std::vector<RasterTextures> textures_;
    std::vector<raster::Mipmap> mipmaps_;
    std::vector<std::uint32_t> background_;
    std::vector<std::uint32_t> alone_;        // of each pixel, as in Scene
    std::vector<std::uint8_t> still_;         // of each facet
    std::vector<std::uint8_t> turned_to_us_;  // of each facet: 1 where it may be seen
    FinePixels fine_;
    raster::Scene scene_{};
    raster::DrawStripe draw_stripe_;
    StripePool pool_;
    std::vector<Workspace> workspaces_;
    std::vector<StripeList> stripes_;
    std::vector<std::vector<int>> rows_;  // the stripes of each row of stripes
};

}  // namespace

std::unique_ptr<Painter> make_raster_painter(const Face& face, const View& view, const Drawing& drawing) {
    return std::make_unique<RasterPainter>(face, view, drawing);
}

}  // namespace viaface
