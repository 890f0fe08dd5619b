// Texels blended two by two, in whole numbers. For raster_kernel.cpp alone.
#pragma once

#include "synth/picture/raster_scene.hpp"
#include "synth/picture/raster_turn.hpp"
#include "synth/picture/raster_wide.hpp"

namespace viaface::raster::VIAFACE_KERNEL {
namespace {

// Of each of kLanes fragments the upper left one of the two by two texels that it lies among, and their
// weights: in `across` twice as bytes the left and the right ones', kAcross in all, in `down` as half words
// the upper and the lower ones', kDown in all.
struct Quads {
    static constexpr std::int32_t kAcross = 127, kDown = 256;

    const Level* const* levels;
    std::uint32_t offset[kLanes];  // bytes from Level::border
    std::int32_t across[kLanes], down[kLanes];

    VIAFACE_INLINE const std::uint8_t* upper(int lane) const { return levels[lane]->border + offset[lane]; }
    VIAFACE_INLINE const std::uint8_t* lower(int lane) const { return upper(lane) + levels[lane]->stride; }
};

#if defined(__AVX2__)
VIAFACE_INLINE __m256i texels_of(const Quads& quads, int lane) {
    return _mm256_inserti128_si256(
        _mm256_castsi128_si256(_mm_loadu_si128(reinterpret_cast<const __m128i*>(quads.upper(lane)))),
        _mm_loadu_si128(reinterpret_cast<const __m128i*>(quads.lower(lane))), 1);
}
// Bytes of the left and of the right texel by turns.
VIAFACE_INLINE __m128i by_turns() {
    return _mm_setr_epi8(0, 8, 1, 9, 2, 10, 3, 11, 4, 12, 5, 13, 6, 14, 7, 15);
}
#endif

#if defined(__AVX512F__)
// The weighted sums, byte by byte, of a fragment and of the one eight lanes further on.
VIAFACE_INLINE Wide two_blended(const Quads& quads, int lane) {
    const auto both = [&](const std::int32_t(&weights)[kLanes]) __attribute__((always_inline)) {
        return _mm512_mask_set1_epi32(_mm512_set1_epi32(weights[lane]), 0xff00, weights[lane + 8]);
    };
    const __m512i texels = _mm512_maskz_inserti64x4(0xff, _mm512_castsi256_si512(texels_of(quads, lane)),
                                                    texels_of(quads, lane + 8), 1);
    const __m512i order = _mm512_maskz_broadcast_i32x4(0xffff, by_turns());
    const __m512i rows = _mm512_maddubs_epi16(_mm512_shuffle_epi8(texels, order), both(quads.across));
    const __m512i swapped = _mm512_maskz_permutex_epi64(0xff, rows, 0x4e);  // lower rows before upper ones
    const __m512i bases = _mm512_unpacklo_epi16(rows, swapped);
    const __m512i sums = _mm512_mask_unpackhi_epi16(bases, 0xff00ff00, swapped, rows);
    return Wide(_mm512_madd_epi16(sums, both(quads.down)));
}
#else
// The weighted sums, byte by byte.
VIAFACE_INLINE EightInt blended(const Quads& quads, int lane) {
#if defined(__AVX2__)
    const __m256i order = _mm256_broadcastsi128_si256(by_turns());
    const __m256i rows = _mm256_maddubs_epi16(_mm256_shuffle_epi8(texels_of(quads, lane), order),
                                              _mm256_set1_epi32(quads.across[lane]));
    const __m128i above = _mm256_castsi256_si128(rows), below = _mm256_extracti128_si256(rows, 1);
    const __m128i down = _mm_set1_epi32(quads.down[lane]);
    return EightInt(_mm256_inserti128_si256(
        _mm256_castsi128_si256(_mm_madd_epi16(_mm_unpacklo_epi16(above, below), down)),
        _mm_madd_epi16(_mm_unpackhi_epi16(above, below), down), 1));
#elif defined(__SSE2__)
    const __m128i none = _mm_setzero_si128(), down = _mm_set1_epi32(quads.down[lane]);
    const __m128i across = _mm_set1_epi32((quads.across[lane] & 255) | (quads.across[lane] >> 8 & 255) << 16);
    const auto row = [&](const std::uint8_t* at) __attribute__((always_inline)) {
        const __m128i pairs = _mm_unpacklo_epi8(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(at)),
                                                _mm_loadl_epi64(reinterpret_cast<const __m128i*>(at + 8)));
        return _mm_packs_epi32(_mm_madd_epi16(_mm_unpacklo_epi8(pairs, none), across),
                               _mm_madd_epi16(_mm_unpackhi_epi8(pairs, none), across));
    };
    const __m128i above = row(quads.upper(lane)), below = row(quads.lower(lane));
    const FourInt low = FourInt(_mm_madd_epi16(_mm_unpacklo_epi16(above, below), down)),
                  high = FourInt(_mm_madd_epi16(_mm_unpackhi_epi16(above, below), down));
    return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
#else
    const std::int32_t left = quads.across[lane] & 255, right = quads.across[lane] >> 8 & 255;
    const std::int32_t above = quads.down[lane] & 0xffff, below = quads.down[lane] >> 16;
    const std::uint8_t *upper = quads.upper(lane), *lower = quads.lower(lane);
    EightInt sums;
    for (int i = 0; i < 8; ++i)
        sums[i] = (upper[i] * left + upper[i + 8] * right) * above +
                  (lower[i] * left + lower[i + 8] * right) * below;
    return sums;
#endif
}
#endif

VIAFACE_INLINE void blend(const Quads& quads, Wide (&channels)[8]) {
#if defined(__AVX512F__)
    for (int i = 0; i < 8; ++i) channels[i] = two_blended(quads, i);
    turn_joined(channels);
#else
    Eight rows[kLanes];
    for (int lane = 0; lane < kLanes; ++lane) rows[lane] = Eight(blended(quads, lane));
    turn(rows, channels);
#endif
    constexpr float kAll = 255.0f * Quads::kAcross * Quads::kDown;
    for (Wide& channel : channels) channel = __builtin_convertvector(WideInt(channel), Wide) * (1 / kAll);
}

}  // namespace
}  // namespace viaface::raster::VIAFACE_KERNEL
