#include <Eigen/Geometry>
#include <algorithm>
#include <cstring>

#include "synth/picture/background.hpp"
#include "synth/picture/fine_pixels.hpp"
#include "synth/picture/painter.hpp"
#include "synth/picture/raster_nodes.hpp"
#include "synth/picture/raster_scene.hpp"
#include "synth/picture/raster_textures.hpp"
#include "synth/picture/stripe_lists.hpp"
#include "synth/picture/work_pool.hpp"

namespace viaface {
namespace {

using Eigen::Vector3f;

constexpr float kFold = 1.0f;   // slope, depth per width
constexpr float kStep = 0.75f;  // pixels

const raster::Kernel& kernel_of(Instructions widest) {
#ifdef VIAFACE_AVX512_KERNEL
    const bool has_avx512 = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
                            __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
    if (widest >= Instructions::kAvx512 && has_avx512) return raster::avx512::kKernel;
#endif
#ifdef VIAFACE_AVX2_KERNEL
    if (widest >= Instructions::kAvx2 && __builtin_cpu_supports("avx2")) return raster::avx2::kKernel;
#endif
    static_cast<void>(widest);
    return raster::baseline::kKernel;
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
    std::vector<std::int32_t> mixed;

    explicit Workspace(int width)
        : middles(std::size_t(width + raster::kPixelsBeyond) * raster::kStripeRows),
          samples(std::size_t(width + 1) * raster::kStripeRows * raster::kSamples),
          sums(std::size_t(width) * raster::kStripeRows),
          mixed(sums.size()) {}

    raster::Scratch scratch() { return {middles.front(), samples.front(), sums.data(), mixed.data()}; }
};

// What is known of each facet before it is drawn.
struct FacetArrays {
    std::vector<raster::Triangle> triangles;
    std::vector<raster::Bounds> boxes;
    std::vector<std::uint8_t> seen, still;  // as in raster::Triangles and raster::Scene

    explicit FacetArrays(std::size_t facets)
        : triangles(facets), boxes(facets), seen(facets), still(facets) {}
};

raster::Bounds bounds_of(const Rect& rect) {
    return {rect.left, rect.bottom, rect.left + rect.width, rect.bottom + rect.height};
}

// What holds them all.
raster::Bounds bounds_of(std::span<const Rect> rects) {
    raster::Bounds all = bounds_of(rects.front());
    for (const Rect& rect : rects) {
        const raster::Bounds one = bounds_of(rect);
        all = {std::min(all.left, one.left), std::min(all.bottom, one.bottom), std::max(all.right, one.right),
               std::max(all.top, one.top)};
    }
    return all;
}

class RasterPainter : public Painter {
  public:
    RasterPainter(const Face& face, const Surfaces& surfaces, const View& view, Instructions widest,
                  WorkPool& pool)
        : kernel_(kernel_of(widest)),
          pool_(pool),
          facets_(facets_of(face)),
          nodes_(face, view, kernel_),
          background_(std::size_t(view.width) * view.height),
          alone_(background_.size()),
          of_facets_(facets_.size()),
          visible_(WorkPool::pieces(int(facets_.size()))),
          fine_(facets_, face.weld, view.width, view.height),
          lists_(view.height),
          workspaces_(pool.threads(), Workspace(view.width)) {
        prepare_textures(surfaces);
        const Texture background = make_background(view);
        std::memcpy(background_.data(), background.pixels.data(), background.pixels.size());
        prepare_scene(view);
    }

    void paint(const PosedVertices& posed, std::span<const Rect> rects, bool again,
               std::uint8_t* rgba) override {
        nodes_.place(posed, again, pool_);
        raster::Scene scene = scene_;
        scene.rgba = reinterpret_cast<std::uint32_t*>(rgba);
        scene.opening = bounds_of(posed.mouth().opening());
        const Sight sight{facets_, of_facets_.boxes, of_facets_.seen, scene.opening,
                          rects.empty() ? raster::Bounds{} : bounds_of(rects)};
        pool_.share_rows(int(facets_.size()), [&](int first, int end, int) {
            for (int i = first; i < end; ++i) of_facets_.still[i] = again && !changed(posed, facets_[i]);
            kernel_.set_up(scene, first, end);
            find_visible(sight, first, end, visible_[first / WorkPool::kRowsAtOnce]);
        });
        if (rects.empty()) return;
        fine_.find_outlines(of_facets_.seen, pool_);
        pool_.share(2, [&](int item, int) {
            item == 0 ? lists_.list(rects, visible_) : fine_.mark(nodes_.nodes(), visible_, sight.drawn);
        });
        pool_.share(int(lists_.stripes().size()), [&](int item, int thread) {
            const auto& [bounds, facets] = lists_.stripes()[item];
            kernel_.draw(scene, {bounds, facets.data(), static_cast<std::int32_t>(facets.size())},
                         workspaces_[thread].scratch());
        });
    }

  private:
    void prepare_textures(const Surfaces& surfaces) {
        for (int i = 0; i < kMaterials; ++i) {
            textures_.emplace_back(pack(surfaces[i], static_cast<Material>(i)));
            levels_.insert(levels_.end(), textures_.back().levels().begin(), textures_.back().levels().end());
        }
        for (const raster::Facet& facet : facets_) texel_ways_.push_back(texel_ways(facet));
    }

    raster::TexelWays texel_ways(const raster::Facet& facet) const {
        const raster::Level& finest = levels_[facet.material * raster::kLevels];
        const raster::Node &from = nodes_.nodes()[facet.node[0]], &to_1 = nodes_.nodes()[facet.node[1]],
                           &to_2 = nodes_.nodes()[facet.node[2]];
        return {(to_1.s - from.s) * finest.columns, (to_1.t - from.t) * finest.rows,
                (to_2.s - from.s) * finest.columns, (to_2.t - from.t) * finest.rows};
    }

    void prepare_scene(const View& view) {
        scene_.nodes = nodes_.nodes().data();
        scene_.facets = facets_.data();
        scene_.texel_ways = texel_ways_.data();
        scene_.triangles = {of_facets_.triangles.data(), of_facets_.boxes.data(), of_facets_.seen.data()};
        scene_.levels = levels_.data();
        scene_.background = background_.data();
        scene_.alone = alone_.data();
        scene_.still = of_facets_.still.data();
        scene_.fine = fine_.bits().data();
        scene_.fine_words = fine_.words();
        scene_.width = view.width;
        const Camera camera = camera_of(view);
        const auto share = static_cast<float>(pixel_size(view) / camera.place.norm());
        scene_.fold = kFold * share;
        scene_.step = kStep * share;
        if (camera.orthographic) {
            scene_.to_camera[0][2] = 1;
            return;
        }
        // A pixel's ray ends where clip x and y are its own and w = 1.
        const Eigen::Matrix3d clip_from_way = (Eigen::Matrix3d() << camera.clip_from_world.block<2, 3>(0, 0),
                                               camera.clip_from_world.block<1, 3>(3, 0))
                                                  .finished();
        const Eigen::Matrix3d way_from_clip = clip_from_way.inverse();
        const auto set = [&](int i, double x, double y, double w) {
            const Vector3f way = -(way_from_clip * Eigen::Vector3d(x, y, w)).cast<float>();
            std::copy(way.data(), way.data() + 3, scene_.to_camera[i]);
        };
        set(0, 1.0 / view.width - 1, 1.0 / view.height - 1, 1);
        set(1, 2.0 / view.width, 0, 0);
        set(2, 0, 2.0 / view.height, 0);
    }

    static bool changed(const PosedVertices& posed, const raster::Facet& facet) {
        const auto& [a, b, c] = facet.node;
        return posed.changed(a) || posed.changed(b) || posed.changed(c);
    }

    const raster::Kernel& kernel_;
    WorkPool& pool_;
    std::vector<raster::Facet> facets_;
    RasterNodes nodes_;
    std::vector<raster::TexelWays> texel_ways_;
    std::vector<RasterTextures> textures_;
    std::vector<raster::Level> levels_;  // of all textures
    std::vector<std::uint32_t> background_;
    std::vector<std::uint32_t> alone_;  // of each pixel, as in Scene
    FacetArrays of_facets_;
    std::vector<std::vector<VisibleFacet>> visible_;  // piece by piece
    FinePixels fine_;
    StripeLists lists_;
    raster::Scene scene_{};
    std::vector<Workspace> workspaces_;
};

}  // namespace

std::unique_ptr<Painter> make_raster_painter(const Face& face, const Surfaces& surfaces, const View& view,
                                             Instructions widest, WorkPool& pool) {
    return std::make_unique<RasterPainter>(face, surfaces, view, widest, pool);
}

}  // namespace viaface
