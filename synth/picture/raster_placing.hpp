// Posed vertices as nodes of the picture, kLanes at a time. For raster_kernel.cpp alone.
#pragma once

#include "synth/picture/raster_scene.hpp"
#include "synth/picture/raster_threes.hpp"
#include "synth/picture/raster_turn.hpp"
#include "synth/picture/raster_wide.hpp"

namespace viaface::raster::VIAFACE_KERNEL {
namespace {

VIAFACE_INLINE Wide row_times(const float (&row)[4], const Three& way) {
    return row[0] * way.x + row[1] * way.y + row[2] * way.z;
}

class PlacingLanes {
  public:
    // The last node is repeated where there are not enough.
    VIAFACE_INLINE PlacingLanes(const Placing& placing, const std::int32_t* nodes, int count)
        : placing_(placing) {
        for (int lane = 0; lane < kLanes; ++lane) nodes_[lane] = nodes[smaller(lane, count - 1)];
    }

    VIAFACE_INLINE void place() const {
        Eight vertices[kLanes];
        Four tangents[kLanes];
        std::int32_t lashes[kLanes];
        for (int lane = 0; lane < kLanes; ++lane) {
            vertices[lane] = load<Eight>(placing_.vertices + 8 * std::ptrdiff_t(nodes_[lane]));
            tangents[lane] = load<Four>(placing_.tangents + 4 * std::ptrdiff_t(nodes_[lane]));
            lashes[lane] = -std::int32_t(placing_.lash[nodes_[lane]]);
        }
        Wide vertex[8], tangent[4];
        turn(vertices, vertex);
        turn(tangents, tangent);
        const Three normal{vertex[3], vertex[4], vertex[5]};
        const Three along = across({tangent[0], tangent[1], tangent[2]}, normal);
        const Three turned = in_world(normal), turned_along = in_world(along);
        Wide place[4];  // as in Place
        put(world_place({vertex[0], vertex[1], vertex[2]}, load<WideInt>(lashes)), place);
        write(0, place);
        write(4, {turned.x, turned.y, turned.z, turned_along.x});
        write(8, {turned_along.y, turned_along.z, vertex[6], vertex[7]});
    }

  private:
    static VIAFACE_INLINE Three across(const Three& tangent, const Three& normal) {
        return unit(tangent - normal * dot(normal, tangent));
    }

    VIAFACE_INLINE Three in_world(const Three& way) const {
        const auto& m = placing_.world_from_head;
        return {row_times(m[0], way), row_times(m[1], way), row_times(m[2], way)};
    }

    VIAFACE_INLINE Three world_place(const Three& place, WideInt lash) const {
        const auto& m = placing_.world_from_head;
        const Three world = in_world(place) + three(m[0][3], m[1][3], m[2][3]);
        const Three before = world + unit(three(placing_.eye) - world) * wide(placing_.lashes_before);
        return {lash ? before.x : world.x, lash ? before.y : world.y, lash ? before.z : world.z};
    }

    VIAFACE_INLINE void put(const Three& world, Wide (&place)[4]) const {
        const auto& m = placing_.clip_from_world;
        const Wide x = row_times(m[0], world) + m[0][3], y = row_times(m[1], world) + m[1][3],
                   z = row_times(m[2], world) + m[2][3], w = row_times(m[3], world) + m[3][3];
        const Wide shrink = 1.0f / w, right = x * shrink * placing_.half_width,
                   up = y * shrink * placing_.half_height;
        const WideInt can = (w > 0.0f) & (z <= w) & (z >= -w) & (right < float(kGuard)) &
                            (right > -float(kGuard)) & (up < float(kGuard)) & (up > -float(kGuard));
        const Wide near = placing_.orthographic ? (1.0f + world.z * placing_.far) * placing_.far : shrink;
        place[0] = Wide(on_grid(right + placing_.half_width) & can);
        place[1] = Wide(on_grid(up + placing_.half_height) & can);
        place[2] = Wide(WideInt(near) & can);
        place[3] = Wide{};
    }

    // To the nearest step: beyond 2^23 numbers have no fractions.
    static VIAFACE_INLINE WideInt on_grid(Wide pixels) {
        constexpr float kWhole = 1.5f * (1 << 23);
        const Wide within = lesser(greater(pixels, wide(-2.0f * kGuard)), wide(2.0f * kGuard));
        return __builtin_convertvector((within * float(kSteps) + kWhole) - kWhole, WideInt);
    }

    // Four numbers of each node, from the first on.
    VIAFACE_INLINE void write(int first, const Wide (&numbers)[4]) const {
        Four rows[kLanes];
        turn(numbers, rows);
        for (int lane = 0; lane < kLanes; ++lane)
            store(reinterpret_cast<std::byte*>(placing_.nodes + nodes_[lane]) + 4 * first, rows[lane]);
    }

    const Placing& placing_;
    std::int32_t nodes_[kLanes];
};

void place(const Placing& placing, const std::int32_t* nodes, int count) {
    for (int i = 0; i < count; i += kLanes) PlacingLanes(placing, nodes + i, count - i).place();
}

}  // namespace
}  // namespace viaface::raster::VIAFACE_KERNEL
