// Rows become columns, and back. For raster_kernel.cpp alone.
#pragma once

#include "synth/picture/raster_wide.hpp"

namespace viaface::raster::VIAFACE_KERNEL {
namespace {

// From every four lanes the first two of each vector by turns, and so on, as transposing fours needs them.
VIAFACE_INLINE Four first_ones(Four a, Four b) { return __builtin_shufflevector(a, b, 0, 4, 1, 5); }
VIAFACE_INLINE Four last_ones(Four a, Four b) { return __builtin_shufflevector(a, b, 2, 6, 3, 7); }
VIAFACE_INLINE Four first_twos(Four a, Four b) { return __builtin_shufflevector(a, b, 0, 1, 4, 5); }
VIAFACE_INLINE Four last_twos(Four a, Four b) { return __builtin_shufflevector(a, b, 2, 3, 6, 7); }

VIAFACE_INLINE Eight first_ones(Eight a, Eight b) {
    return __builtin_shufflevector(a, b, 0, 8, 1, 9, 4, 12, 5, 13);
}
VIAFACE_INLINE Eight last_ones(Eight a, Eight b) {
    return __builtin_shufflevector(a, b, 2, 10, 3, 11, 6, 14, 7, 15);
}
VIAFACE_INLINE Eight first_twos(Eight a, Eight b) {
    return __builtin_shufflevector(a, b, 0, 1, 8, 9, 4, 5, 12, 13);
}
VIAFACE_INLINE Eight last_twos(Eight a, Eight b) {
    return __builtin_shufflevector(a, b, 2, 3, 10, 11, 6, 7, 14, 15);
}

#if defined(__AVX512F__)
VIAFACE_INLINE Wide first_ones(Wide a, Wide b) {
    return __builtin_shufflevector(a, b, 0, 16, 1, 17, 4, 20, 5, 21, 8, 24, 9, 25, 12, 28, 13, 29);
}
VIAFACE_INLINE Wide last_ones(Wide a, Wide b) {
    return __builtin_shufflevector(a, b, 2, 18, 3, 19, 6, 22, 7, 23, 10, 26, 11, 27, 14, 30, 15, 31);
}
VIAFACE_INLINE Wide first_twos(Wide a, Wide b) {
    return __builtin_shufflevector(a, b, 0, 1, 16, 17, 4, 5, 20, 21, 8, 9, 24, 25, 12, 13, 28, 29);
}
VIAFACE_INLINE Wide last_twos(Wide a, Wide b) {
    return __builtin_shufflevector(a, b, 2, 3, 18, 19, 6, 7, 22, 23, 10, 11, 26, 27, 14, 15, 30, 31);
}
#endif

// Four vectors, in each four lanes for itself.
template <class Vector>
VIAFACE_INLINE void transpose_fours(Vector* r) {
    const Vector a = first_ones(r[0], r[1]), b = first_ones(r[2], r[3]), c = last_ones(r[0], r[1]),
                 d = last_ones(r[2], r[3]);
    r[0] = first_twos(a, b), r[1] = last_twos(a, b), r[2] = first_twos(c, d), r[3] = last_twos(c, d);
}

VIAFACE_INLINE Eight joined(Four low, Four high) {
    return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
}

// Rows of four become four columns, and back.
VIAFACE_INLINE void turn(const Four (&rows)[kLanes], Wide (&columns)[4]) {
    for (int i = 0; i < 4; ++i) {
#if defined(__AVX512F__)
        const Eight low = joined(rows[i], rows[i + 4]), high = joined(rows[i + 8], rows[i + 12]);
        columns[i] = _mm512_maskz_insertf32x8(0xffff, _mm512_castps256_ps512(low), high, 1);
#else
        columns[i] = joined(rows[i], rows[i + 4]);
#endif
    }
    transpose_fours(columns);
}

VIAFACE_INLINE void turn(const Wide (&columns)[4], Four (&rows)[kLanes]) {
    Wide r[4] = {columns[0], columns[1], columns[2], columns[3]};
    transpose_fours(r);
    for (int i = 0; i < 4; ++i) {
#if defined(__AVX512F__)
        rows[i] = _mm512_maskz_extractf32x4_ps(0xf, r[i], 0);
        rows[i + 4] = _mm512_maskz_extractf32x4_ps(0xf, r[i], 1);
        rows[i + 8] = _mm512_maskz_extractf32x4_ps(0xf, r[i], 2);
        rows[i + 12] = _mm512_maskz_extractf32x4_ps(0xf, r[i], 3);
#else
        rows[i] = __builtin_shufflevector(r[i], r[i], 0, 1, 2, 3);
        rows[i + 4] = __builtin_shufflevector(r[i], r[i], 4, 5, 6, 7);
#endif
    }
}

// Rows of eight become eight columns; each vector holds a row, and where there are sixteen rows the one that
// is eight rows further on.
VIAFACE_INLINE void turn_joined(Wide (&columns)[8]) {
    transpose_fours(columns);
    transpose_fours(columns + 4);
    for (int i = 0; i < 4; ++i) {
        const Wide a = columns[i], b = columns[i + 4];
#if defined(__AVX512F__)
        columns[i] = __builtin_shufflevector(a, b, 0, 1, 2, 3, 16, 17, 18, 19, 8, 9, 10, 11, 24, 25, 26, 27);
        columns[i + 4] =
            __builtin_shufflevector(a, b, 4, 5, 6, 7, 20, 21, 22, 23, 12, 13, 14, 15, 28, 29, 30, 31);
#else
        columns[i] = __builtin_shufflevector(a, b, 0, 1, 2, 3, 8, 9, 10, 11);
        columns[i + 4] = __builtin_shufflevector(a, b, 4, 5, 6, 7, 12, 13, 14, 15);
#endif
    }
}

VIAFACE_INLINE void turn(const Eight (&rows)[kLanes], Wide (&columns)[8]) {
    for (int i = 0; i < 8; ++i) {
#if defined(__AVX512F__)
        columns[i] = _mm512_maskz_insertf32x8(0xffff, _mm512_castps256_ps512(rows[i]), rows[i + 8], 1);
#else
        columns[i] = rows[i];
#endif
    }
    turn_joined(columns);
}

#if defined(__AVX512F__)
// As many rows as columns.
VIAFACE_INLINE void transpose(Wide (&r)[16]) {
    for (int i = 0; i < 16; i += 4) transpose_fours(r + i);
    for (int i = 0; i < 4; ++i) {
        const Wide a = _mm512_maskz_shuffle_f32x4(0xffff, r[i], r[i + 4], 0x44),
                   b = _mm512_maskz_shuffle_f32x4(0xffff, r[i], r[i + 4], 0xee),
                   c = _mm512_maskz_shuffle_f32x4(0xffff, r[i + 8], r[i + 12], 0x44),
                   d = _mm512_maskz_shuffle_f32x4(0xffff, r[i + 8], r[i + 12], 0xee);
        r[i] = _mm512_maskz_shuffle_f32x4(0xffff, a, c, 0x88);
        r[i + 4] = _mm512_maskz_shuffle_f32x4(0xffff, a, c, 0xdd);
        r[i + 8] = _mm512_maskz_shuffle_f32x4(0xffff, b, d, 0x88);
        r[i + 12] = _mm512_maskz_shuffle_f32x4(0xffff, b, d, 0xdd);
    }
}
#endif

}  // namespace
}  // namespace viaface::raster::VIAFACE_KERNEL
