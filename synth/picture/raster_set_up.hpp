// Facets as triangles of the picture, kLanes at a time. For raster_kernel.cpp alone.
#pragma once

#include "synth/picture/raster_scene.hpp"
#include "synth/picture/raster_turn.hpp"
#include "synth/picture/raster_wide.hpp"

namespace viaface::raster::VIAFACE_KERNEL {
namespace {

constexpr int kGridBits = 7, kEighthBits = 4;
static_assert(1 << kGridBits == kSteps && 8 << kEighthBits == kSteps);

struct Corner {
    WideInt x, y;
    Wide nearness;

    VIAFACE_INLINE Corner(const Scene& scene, int first, int corner) {
        Four rows[kLanes];
        for (int lane = 0; lane < kLanes; ++lane)
            rows[lane] = load<Four>(&scene.nodes[scene.facets[first + lane].node[corner]].place);
        Wide columns[4];
        turn(rows, columns);
        x = WideInt(columns[0]), y = WideInt(columns[1]), nearness = columns[2];
    }
};

// An edge function: positive on the left of the way from one corner to another.
struct Edge {
    WideInt right, up;  // per step of the grid

    VIAFACE_INLINE Edge(const Corner& from, const Corner& to) : right(from.y - to.y), up(to.x - from.x) {}

    // At a place seen from one of the corners; the whole number holds for small triangles alone.
    struct Value {
        WideInt whole;
        Wide number;
    };
    VIAFACE_INLINE Value at(WideInt x, WideInt y, WideInt small) const {
        const WideInt whole = (right & small) * x + (up & small) * y;
        Wide number = __builtin_convertvector(whole, Wide);
        for (unsigned large = negative_lanes(~small); large != 0; large &= large - 1) {
            const int i = __builtin_ctz(large);
            number[i] = float(std::int64_t(right[i]) * x[i] + std::int64_t(up[i]) * y[i]);
        }
        return {whole, number};
    }
    VIAFACE_INLINE void reverse(WideInt where) { right = (right ^ where) - where, up = (up ^ where) - where; }
    // A sample on the edge belongs to the triangle on one side alone.
    VIAFACE_INLINE WideInt owns() const { return (right > 0) | ((right == 0) & (up < 0)); }
};

class SettingUp {
  public:
    VIAFACE_INLINE SettingUp(const Scene& scene, int first)
        : scene_(scene),
          first_(first),
          corners_{{scene, first, 0}, {scene, first, 1}, {scene, first, 2}},
          edges_{{corners_[1], corners_[2]}, {corners_[2], corners_[0]}, {corners_[0], corners_[1]}} {
        find_boxes();
        face_camera();
        find_planes();
    }

    VIAFACE_INLINE void write() const {
        Four firsts[kLanes], rights[kLanes], ups[kLanes], planes[kLanes], boxes[kLanes];
        turn({Wide(starts_[0]), Wide(starts_[1]), Wide(starts_[2]), Wide(small_)}, firsts);
        turn({Wide(edges_[0].right), Wide(edges_[1].right), Wide(edges_[2].right), Wide{}}, rights);
        turn({Wide(edges_[0].up), Wide(edges_[1].up), Wide(edges_[2].up), Wide{}}, ups);
        turn({nearness_, nearness_right_, nearness_up_, __builtin_convertvector(material_, Wide)}, planes);
        turn({Wide(left_), Wide(bottom_), Wide(right_), Wide(top_)}, boxes);
        std::int32_t levels_of[kLanes];
        store(levels_of, levels());
        for (int lane = 0; lane < kLanes; ++lane) {
            scene_.facets[first_ + lane].level = levels_of[lane];
            Triangle& triangle = scene_.triangles.triangles[first_ + lane];
            store(triangle.first, firsts[lane]);
            store(triangle.right, rights[lane]);
            store(triangle.up, ups[lane]);
            store(&triangle.nearness, planes[lane]);
            store(scene_.triangles.boxes + first_ + lane, boxes[lane]);
            scene_.triangles.seen[first_ + lane] = std::uint8_t(seen_ >> lane & 1);
        }
    }

  private:
    VIAFACE_INLINE void find_boxes() {
        const auto& [a, b, c] = corners_;
        left_ = lesser(lesser(a.x, b.x), c.x) >> kGridBits;
        bottom_ = lesser(lesser(a.y, b.y), c.y) >> kGridBits;
        right_ = (greater(greater(a.x, b.x), c.x) >> kGridBits) + 1;
        top_ = (greater(greater(a.y, b.y), c.y) >> kGridBits) + 1;
        small_ = (right_ - left_ <= kSmall) & (top_ - bottom_ <= kSmall);
    }

    VIAFACE_INLINE void face_camera() {
        const auto& [a, b, c] = corners_;
        area_ = edges_[2].at(c.x - a.x, c.y - a.y, small_).number;
        std::int32_t sides[kLanes], materials[kLanes];
        for (int lane = 0; lane < kLanes; ++lane) {
            const Facet& facet = scene_.facets[first_ + lane];
            sides[lane] = -std::int32_t(facet.two_sided), materials[lane] = facet.material;
        }
        material_ = load<WideInt>(materials);
        const WideInt away = load<WideInt>(sides) & (area_ < 0);
        area_ = away ? -area_ : area_;
        for (Edge& edge : edges_) edge.reverse(away);
        seen_ = negative_lanes((area_ > 0) & (a.nearness != 0) & (b.nearness != 0) & (c.nearness != 0));
    }

    VIAFACE_INLINE void find_planes() {
        const Wide share = 1.0f / area_;
        for (int i = 0; i < 3; ++i) {
            const Corner& on = corners_[(i + 1) % 3];
            const Edge::Value value = edges_[i].at(left_ * kSteps + kSteps / 2 - on.x,
                                                   bottom_ * kSteps + kSteps / 2 - on.y, small_);
            starts_[i] = (value.whole - 1 - edges_[i].owns()) >> kEighthBits;
            const Wide near = corners_[i].nearness * share;
            nearness_ += value.number * near;
            nearness_right_ += per_pixel(edges_[i].right) * near;
            nearness_up_ += per_pixel(edges_[i].up) * near;
        }
    }

    static VIAFACE_INLINE Wide per_pixel(WideInt per_step) {
        return __builtin_convertvector(per_step, Wide) * float(kSteps);
    }

    // Those whose texels are nearest to a pixel in size, along the axis where they are most.
    VIAFACE_INLINE WideInt levels() const {
        Four rows[kLanes];
        for (int lane = 0; lane < kLanes; ++lane) rows[lane] = load<Four>(scene_.texel_ways + first_ + lane);
        Wide ways[4];
        turn(rows, ways);
        const Wide most = greater(squared_way(edges_[1].right, edges_[2].right, ways),
                                  squared_way(edges_[1].up, edges_[2].up, ways)) /
                          (area_ * area_);  // texels per pixel, squared
        WideInt level{};
        float limit = 2;
        for (int i = 1; i < kLevels; ++i, limit *= 4) level -= most > limit;
        return level + material_ * kLevels;
    }

    static VIAFACE_INLINE Wide squared_way(WideInt slope_1, WideInt slope_2, const Wide (&ways)[4]) {
        const Wide to_1 = per_pixel(slope_1), to_2 = per_pixel(slope_2);
        const Wide s = to_1 * ways[0] + to_2 * ways[2], t = to_1 * ways[1] + to_2 * ways[3];
        return s * s + t * t;
    }

    const Scene& scene_;
    const int first_;
    const Corner corners_[3];
    Edge edges_[3];  // opposite the corners
    WideInt left_, bottom_, right_, top_, small_;
    Wide area_;
    unsigned seen_;
    WideInt material_;
    WideInt starts_[3];
    Wide nearness_{}, nearness_right_{}, nearness_up_{};
};

static_assert(kFacetsAtOnce % kLanes == 0);

VIAFACE_INLINE bool all_still(const std::uint8_t* facets) {
    std::uint64_t eights[kLanes / 8], all = ~std::uint64_t{0};
    __builtin_memcpy(eights, facets, sizeof eights);
    for (const std::uint64_t still : eights) all &= still;
    return all == 0x0101010101010101;
}

void set_up(const Scene& scene, int first, int end) {
    for (int i = first; i < end; i += kLanes) {
        if (!all_still(scene.still + i)) SettingUp(scene, i).write();
    }
}

}  // namespace
}  // namespace viaface::raster::VIAFACE_KERNEL
