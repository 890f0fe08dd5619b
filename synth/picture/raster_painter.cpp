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

class RasterPainter : public Painter {
  public:
    RasterPainter(const Face& face, const View& view, Instructions instructions, WorkPool& pool)
        : facets_(facets_of(face)),
          nodes_(face, view),
          background_(std::size_t(view.width) * view.height),
          alone_(background_.size()),
          still_(facets_.size()),
          seen_(facets_.size()),
          fine_(facets_, face.weld, view.width, view.height),
          lists_(view.height),
          draw_stripe_(kernel_of(instructions)),
          pool_(pool),
          workspaces_(pool.threads(), Workspace(view.width)) {
        prepare_textures(face);
        const Texture background = make_background(view);
        std::memcpy(background_.data(), background.pixels.data(), background.pixels.size());
        prepare_scene(view);
    }

    void paint(const PosedVertices& posed, std::span<const Rect> rects, const Rect& opening, bool again,
               std::uint8_t* rgba) override {
        nodes_.place(posed, pool_);
        look_at_facets(posed, again);
        raster::Scene scene = scene_;
        scene.rgba = reinterpret_cast<std::uint32_t*>(rgba);
        scene.opening = {opening.left, opening.bottom, opening.left + opening.width,
                         opening.bottom + opening.height};
        pool_.share(2, [&](int item, int) {
            if (item == 0)
                lists_.list(rects, {facets_, nodes_.places(), seen_, scene.opening});
            else
                fine_.find(nodes_.places(), seen_, scene.opening);
        });
        pool_.share(int(lists_.stripes().size()), [&](int item, int thread) {
            const StripeList& list = lists_.stripes()[item];
            const auto facets = static_cast<std::int32_t>(list.facets.size());
            draw_stripe_(scene, {list.bounds, list.facets.data(), facets},
                         workspaces_[thread].scratch(facets));
        });
    }

  private:
    void prepare_textures(const Face& face) {
        for (int i = 0; i < kMaterials; ++i) {
            textures_.emplace_back(pack(face.surfaces[i], static_cast<Material>(i)));
            mipmaps_.push_back(textures_.back().mipmap());
        }
    }

    void prepare_scene(const View& view) {
        scene_.places = nodes_.places().data();
        scene_.nodes = nodes_.nodes().data();
        scene_.facets = facets_.data();
        scene_.mipmaps = mipmaps_.data();
        scene_.background = background_.data();
        scene_.alone = alone_.data();
        scene_.still = still_.data();
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

    // What of each facet has not moved, and what is turned towards the camera.
    void look_at_facets(const PosedVertices& posed, bool again) {
        pool_.share_rows(int(facets_.size()), [&](int first, int end) {
            for (int i = first; i < end; ++i) {
                const auto& [a, b, c] = facets_[i].node;
                still_[i] = again && !posed.changed(a) && !posed.changed(b) && !posed.changed(c);
                const std::vector<raster::Place>& at = nodes_.places();
                seen_[i] = at[a].nearness != 0 && at[b].nearness != 0 && at[c].nearness != 0 &&
                           (facets_[i].two_sided || !turned_away(at[a], at[b], at[c]));
            }
        });
    }

    static bool turned_away(const raster::Place& a, const raster::Place& b, const raster::Place& c) {
        return std::int64_t(b.x - a.x) * (c.y - a.y) - std::int64_t(b.y - a.y) * (c.x - a.x) <= 0;
    }

    std::vector<raster::Facet> facets_;
    RasterNodes nodes_;
    std::vector<RasterTextures> textures_;
    std::vector<raster::Mipmap> mipmaps_;
    std::vector<std::uint32_t> background_;
    std::vector<std::uint32_t> alone_;  // of each pixel, as in Scene
    std::vector<std::uint8_t> still_;   // of each facet
    std::vector<std::uint8_t> seen_;    // of each facet: 1 where it may be seen
    FinePixels fine_;
    StripeLists lists_;
    raster::Scene scene_{};
    raster::DrawStripe draw_stripe_;
    WorkPool& pool_;
    std::vector<Workspace> workspaces_;
};

}  // namespace

std::unique_ptr<Painter> make_raster_painter(const Face& face, const View& view, Instructions instructions,
                                             WorkPool& pool) {
    return std::make_unique<RasterPainter>(face, view, instructions, pool);
}

}  // namespace viaface
