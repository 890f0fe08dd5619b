// Several numbers at a time. Only operations that IEEE 754 fixes to the last bit: every instruction set gives
// the same bytes. For raster_kernel.cpp alone.
#pragma once

#if defined(__SSE2__)
#include <immintrin.h>
#endif

#include <cstdint>

#include "synth/picture/raster_scene.hpp"

namespace viaface::raster::VIAFACE_KERNEL {
namespace {

typedef float Four __attribute__((vector_size(16)));
typedef std::int32_t FourInt __attribute__((vector_size(16)));
typedef float Eight __attribute__((vector_size(32)));
typedef std::int32_t EightInt __attribute__((vector_size(32)));

// Fragments or facets, as many as the instructions take. (Intrinsics of sixteen lanes are called with a mask
// that has all of them: GCC 12 warns of the plain ones, which name a variable that has no value.)
#if defined(__AVX512F__)
constexpr int kLanes = 16;
#else
constexpr int kLanes = 8;
#endif
typedef float Wide __attribute__((vector_size(4 * kLanes)));
typedef std::int32_t WideInt __attribute__((vector_size(4 * kLanes)));

VIAFACE_INLINE EightInt eight(std::int32_t v) { return EightInt{} + v; }
VIAFACE_INLINE Wide wide(float v) { return Wide{} + v; }
VIAFACE_INLINE WideInt wide(std::int32_t v) { return WideInt{} + v; }

template <class Vector, class T>
VIAFACE_INLINE Vector load(const T* from) {
    Vector v;
    __builtin_memcpy(&v, from, sizeof v);
    return v;
}

template <class Vector, class T>
VIAFACE_INLINE void store(T* to, Vector v) {
    __builtin_memcpy(to, &v, sizeof v);
}

// Of two the second where they cannot be compared.
VIAFACE_INLINE Wide greater(Wide a, Wide b) {
#if defined(__AVX512F__)
    return _mm512_maskz_max_ps(0xffff, a, b);
#elif defined(__AVX__)
    return _mm256_max_ps(a, b);
#else
    return a > b ? a : b;
#endif
}
VIAFACE_INLINE Wide lesser(Wide a, Wide b) {
#if defined(__AVX512F__)
    return _mm512_maskz_min_ps(0xffff, a, b);
#elif defined(__AVX__)
    return _mm256_min_ps(a, b);
#else
    return a < b ? a : b;
#endif
}
VIAFACE_INLINE Four greater(Four a, Four b) {
#if defined(__SSE2__)
    return _mm_max_ps(a, b);
#else
    return a > b ? a : b;
#endif
}
VIAFACE_INLINE WideInt greater(WideInt a, WideInt b) { return a > b ? a : b; }
VIAFACE_INLINE WideInt lesser(WideInt a, WideInt b) { return a < b ? a : b; }
VIAFACE_INLINE Wide positive(Wide v) { return greater(v, Wide{}); }

VIAFACE_INLINE Wide root(Wide v) {
#if defined(__AVX512F__)
    return _mm512_maskz_sqrt_ps(0xffff, v);
#elif defined(__AVX__)
    return _mm256_sqrt_ps(v);
#elif defined(__SSE2__)
    const Four low = _mm_sqrt_ps(__builtin_shufflevector(v, v, 0, 1, 2, 3));
    const Four high = _mm_sqrt_ps(__builtin_shufflevector(v, v, 4, 5, 6, 7));
    return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
#else
    for (int i = 0; i < kLanes; ++i) v[i] = __builtin_sqrtf(v[i]);
    return v;
#endif
}

// The greatest whole number that is not above v, for v within 2^31.
VIAFACE_INLINE Wide floor(Wide v) {
    const Wide whole = __builtin_convertvector(__builtin_convertvector(v, WideInt), Wide);
    return whole > v ? whole - 1.0f : whole;
}

// One bit per lane that is below zero.
VIAFACE_INLINE unsigned negative_lanes(EightInt v) {
#if defined(__AVX__)
    return unsigned(_mm256_movemask_ps(Eight(v)));
#elif defined(__SSE2__)
    const Eight f = Eight(v);
    return unsigned(_mm_movemask_ps(__builtin_shufflevector(f, f, 0, 1, 2, 3)) |
                    _mm_movemask_ps(__builtin_shufflevector(f, f, 4, 5, 6, 7)) << 4);
#else
    unsigned bits = 0;
    for (int i = 0; i < 8; ++i) bits |= unsigned(v[i] < 0) << i;
    return bits;
#endif
}

#if defined(__AVX512F__)
VIAFACE_INLINE unsigned negative_lanes(WideInt v) { return _mm512_movepi32_mask(__m512i(v)); }
#endif

VIAFACE_INLINE unsigned negative_lanes(FourInt v) {
#if defined(__SSE2__)
    return unsigned(_mm_movemask_ps(Four(v)));
#else
    unsigned bits = 0;
    for (int i = 0; i < 4; ++i) bits |= unsigned(v[i] < 0) << i;
    return bits;
#endif
}

#if defined(__AVX2__)
// Of each set of lanes their numbers one after the other, a byte each.
struct Packing {
    std::uint64_t order[256] = {};
    constexpr Packing() {
        for (unsigned lanes = 0; lanes < 256; ++lanes) {
            for (unsigned lane = 0, to = 0; lane < 8; ++lane) {
                if (lanes >> lane & 1) order[lanes] |= std::uint64_t(lane) << (8 * to++);
            }
        }
    }
};
constexpr Packing kPacking;
#endif

// The lanes that have a bit, moved together; what the others hold is not told.
VIAFACE_INLINE EightInt packed(EightInt v, unsigned lanes) {
#if defined(__AVX2__)
    const __m256i order = _mm256_cvtepu8_epi32(_mm_cvtsi64_si128(std::int64_t(kPacking.order[lanes])));
    return EightInt(_mm256_permutevar8x32_epi32(__m256i(v), order));
#else
    EightInt some{};
    for (int to = 0; lanes != 0; lanes &= lanes - 1) some[to++] = v[__builtin_ctz(lanes)];
    return some;
#endif
}

}  // namespace
}  // namespace viaface::raster::VIAFACE_KERNEL
