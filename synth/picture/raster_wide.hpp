// Eight numbers at a time, and threes of them. Only operations that IEEE 754 fixes to the last bit: every
// instruction set gives the same bytes. For raster_kernel.cpp alone.
#pragma once

#if defined(__SSE2__)
#include <immintrin.h>
#endif

#include <cstdint>

#include "synth/picture/raster_scene.hpp"

namespace viaface::raster::VIAFACE_KERNEL {
namespace {

typedef float Wide __attribute__((vector_size(32)));
typedef std::int32_t WideInt __attribute__((vector_size(32)));
typedef float Four __attribute__((vector_size(16)));
typedef std::int32_t FourInt __attribute__((vector_size(16)));

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
#if defined(__AVX__)
    return _mm256_max_ps(a, b);
#else
    return a > b ? a : b;
#endif
}
VIAFACE_INLINE Wide lesser(Wide a, Wide b) {
#if defined(__AVX__)
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
#if defined(__AVX__)
    return _mm256_sqrt_ps(v);
#elif defined(__SSE2__)
    const Four low = _mm_sqrt_ps(__builtin_shufflevector(v, v, 0, 1, 2, 3));
    const Four high = _mm_sqrt_ps(__builtin_shufflevector(v, v, 4, 5, 6, 7));
    return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
#else
    for (int i = 0; i < 8; ++i) v[i] = __builtin_sqrtf(v[i]);
    return v;
#endif
}

// Weights of two by two texels, of eight pixels: twice as bytes the left and the right one's, kAcross in all,
// and as half words the upper and the lower row's, kDown in all.
struct Blend {
    static constexpr std::int32_t kAcross = 127, kDown = 256;
    std::int32_t across, down;
};

// Two texels of eight bytes side by side above two others: their weighted sums byte by byte.
VIAFACE_INLINE WideInt blended(const std::uint8_t* upper, const std::uint8_t* lower, const Blend& weights) {
#if defined(__AVX2__)
    const __m256i both = _mm256_inserti128_si256(
        _mm256_castsi128_si256(_mm_loadu_si128(reinterpret_cast<const __m128i*>(upper))),
        _mm_loadu_si128(reinterpret_cast<const __m128i*>(lower)), 1);
    const __m256i order =
        _mm256_broadcastsi128_si256(_mm_setr_epi8(0, 8, 1, 9, 2, 10, 3, 11, 4, 12, 5, 13, 6, 14, 7, 15));
    const __m256i rows =
        _mm256_maddubs_epi16(_mm256_shuffle_epi8(both, order), _mm256_set1_epi32(weights.across));
    const __m128i above = _mm256_castsi256_si128(rows), below = _mm256_extracti128_si256(rows, 1);
    const __m128i down = _mm_set1_epi32(weights.down);
    return WideInt(_mm256_inserti128_si256(
        _mm256_castsi128_si256(_mm_madd_epi16(_mm_unpacklo_epi16(above, below), down)),
        _mm_madd_epi16(_mm_unpackhi_epi16(above, below), down), 1));
#elif defined(__SSE2__)
    const __m128i none = _mm_setzero_si128(), down = _mm_set1_epi32(weights.down);
    const __m128i across = _mm_set1_epi32((weights.across & 255) | (weights.across >> 8 & 255) << 16);
    const auto row = [&](const std::uint8_t* at) __attribute__((always_inline)) {
        const __m128i pairs = _mm_unpacklo_epi8(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(at)),
                                                _mm_loadl_epi64(reinterpret_cast<const __m128i*>(at + 8)));
        return _mm_packs_epi32(_mm_madd_epi16(_mm_unpacklo_epi8(pairs, none), across),
                               _mm_madd_epi16(_mm_unpackhi_epi8(pairs, none), across));
    };
    const __m128i above = row(upper), below = row(lower);
    const FourInt low = FourInt(_mm_madd_epi16(_mm_unpacklo_epi16(above, below), down)),
                  high = FourInt(_mm_madd_epi16(_mm_unpackhi_epi16(above, below), down));
    return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
#else
    const std::int32_t left = weights.across & 255, right = weights.across >> 8 & 255;
    const std::int32_t above = weights.down & 0xffff, below = weights.down >> 16;
    WideInt sums;
    for (int i = 0; i < 8; ++i)
        sums[i] = (upper[i] * left + upper[i + 8] * right) * above +
                  (lower[i] * left + lower[i + 8] * right) * below;
    return sums;
#endif
}

// The greatest whole number that is not above v, for v within 2^31.
VIAFACE_INLINE Wide floor(Wide v) {
    const Wide whole = __builtin_convertvector(__builtin_convertvector(v, WideInt), Wide);
    return whole > v ? whole - 1.0f : whole;
}

// One bit per lane that is below zero.
VIAFACE_INLINE unsigned negative_lanes(WideInt v) {
#if defined(__AVX__)
    return unsigned(_mm256_movemask_ps(Wide(v)));
#elif defined(__SSE2__)
    const Wide f = Wide(v);
    return unsigned(_mm_movemask_ps(__builtin_shufflevector(f, f, 0, 1, 2, 3)) |
                    _mm_movemask_ps(__builtin_shufflevector(f, f, 4, 5, 6, 7)) << 4);
#else
    unsigned bits = 0;
    for (int i = 0; i < 8; ++i) bits |= unsigned(v[i] < 0) << i;
    return bits;
#endif
}

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

// Rows become columns.
VIAFACE_INLINE void transpose(Wide (&r)[8]) {
    Wide a[8], b[8];
    for (int i = 0; i < 8; i += 2) {
        a[i] = __builtin_shufflevector(r[i], r[i + 1], 0, 8, 1, 9, 4, 12, 5, 13);
        a[i + 1] = __builtin_shufflevector(r[i], r[i + 1], 2, 10, 3, 11, 6, 14, 7, 15);
    }
    for (int i = 0; i < 8; i += 4) {
        b[i] = __builtin_shufflevector(a[i], a[i + 2], 0, 1, 8, 9, 4, 5, 12, 13);
        b[i + 1] = __builtin_shufflevector(a[i], a[i + 2], 2, 3, 10, 11, 6, 7, 14, 15);
        b[i + 2] = __builtin_shufflevector(a[i + 1], a[i + 3], 0, 1, 8, 9, 4, 5, 12, 13);
        b[i + 3] = __builtin_shufflevector(a[i + 1], a[i + 3], 2, 3, 10, 11, 6, 7, 14, 15);
    }
    for (int i = 0; i < 4; ++i) {
        r[i] = __builtin_shufflevector(b[i], b[i + 4], 0, 1, 2, 3, 8, 9, 10, 11);
        r[i + 4] = __builtin_shufflevector(b[i], b[i + 4], 4, 5, 6, 7, 12, 13, 14, 15);
    }
}

VIAFACE_INLINE void transpose(Four (&r)[4]) {
    const Four a = __builtin_shufflevector(r[0], r[1], 0, 4, 1, 5),
               b = __builtin_shufflevector(r[2], r[3], 0, 4, 1, 5),
               c = __builtin_shufflevector(r[0], r[1], 2, 6, 3, 7),
               d = __builtin_shufflevector(r[2], r[3], 2, 6, 3, 7);
    r[0] = __builtin_shufflevector(a, b, 0, 1, 4, 5);
    r[1] = __builtin_shufflevector(a, b, 2, 3, 6, 7);
    r[2] = __builtin_shufflevector(c, d, 0, 1, 4, 5);
    r[3] = __builtin_shufflevector(c, d, 2, 3, 6, 7);
}

VIAFACE_INLINE Wide joined(Four low, Four high) {
    return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
}

// The lanes that have a bit, moved together; what the others hold is not told.
VIAFACE_INLINE WideInt packed(WideInt v, unsigned lanes) {
#if defined(__AVX2__)
    const __m256i order = _mm256_cvtepu8_epi32(_mm_cvtsi64_si128(std::int64_t(kPacking.order[lanes])));
    return WideInt(_mm256_permutevar8x32_epi32(__m256i(v), order));
#else
    WideInt some{};
    for (int to = 0; lanes != 0; lanes &= lanes - 1) some[to++] = v[__builtin_ctz(lanes)];
    return some;
#endif
}

// Rows become columns in the lower four lanes and in the upper four.
VIAFACE_INLINE void transpose_halves(Wide (&r)[4]) {
    const Wide a = __builtin_shufflevector(r[0], r[1], 0, 8, 1, 9, 4, 12, 5, 13),
               b = __builtin_shufflevector(r[2], r[3], 0, 8, 1, 9, 4, 12, 5, 13),
               c = __builtin_shufflevector(r[0], r[1], 2, 10, 3, 11, 6, 14, 7, 15),
               d = __builtin_shufflevector(r[2], r[3], 2, 10, 3, 11, 6, 14, 7, 15);
    r[0] = __builtin_shufflevector(a, b, 0, 1, 8, 9, 4, 5, 12, 13);
    r[1] = __builtin_shufflevector(a, b, 2, 3, 10, 11, 6, 7, 14, 15);
    r[2] = __builtin_shufflevector(c, d, 0, 1, 8, 9, 4, 5, 12, 13);
    r[3] = __builtin_shufflevector(c, d, 2, 3, 10, 11, 6, 7, 14, 15);
}

// Eight rows of four become four columns of eight, and back.
VIAFACE_INLINE void turn(const Four (&rows)[8], Wide (&columns)[4]) {
    for (int i = 0; i < 4; ++i) columns[i] = joined(rows[i], rows[i + 4]);
    transpose_halves(columns);
}

VIAFACE_INLINE void turn(const Wide (&columns)[4], Four (&rows)[8]) {
    Wide r[4] = {columns[0], columns[1], columns[2], columns[3]};
    transpose_halves(r);
    for (int i = 0; i < 4; ++i) {
        rows[i] = __builtin_shufflevector(r[i], r[i], 0, 1, 2, 3);
        rows[i + 4] = __builtin_shufflevector(r[i], r[i], 4, 5, 6, 7);
    }
}

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
