// Threes of several numbers at a time. For raster_kernel.cpp alone.
#pragma once

#include "synth/picture/raster_wide.hpp"

namespace viaface::raster::VIAFACE_KERNEL {
namespace {

struct Three {
    Wide x, y, z;
};

VIAFACE_INLINE Three three(float x, float y, float z) { return {wide(x), wide(y), wide(z)}; }
VIAFACE_INLINE Three three(const float (&v)[3]) { return three(v[0], v[1], v[2]); }
VIAFACE_INLINE Three operator+(const Three& a, const Three& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
VIAFACE_INLINE Three operator-(const Three& a, const Three& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
VIAFACE_INLINE Three operator*(const Three& a, const Three& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
VIAFACE_INLINE Three operator*(const Three& a, Wide b) { return {a.x * b, a.y * b, a.z * b}; }
VIAFACE_INLINE Three operator+(const Three& a, Wide b) { return {a.x + b, a.y + b, a.z + b}; }
VIAFACE_INLINE Three positive(const Three& a) { return {positive(a.x), positive(a.y), positive(a.z)}; }
VIAFACE_INLINE Wide dot(const Three& a, const Three& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
VIAFACE_INLINE Three cross(const Three& a, const Three& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
VIAFACE_INLINE Three unit(const Three& a) { return a * (1.0f / root(dot(a, a))); }
VIAFACE_INLINE Three mix(const Three& a, const Three& b, const Three& share) { return a + (b - a) * share; }

}  // namespace
}  // namespace viaface::raster::VIAFACE_KERNEL
