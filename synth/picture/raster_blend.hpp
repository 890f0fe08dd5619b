// Texels blended two by two, in whole numbers. For raster_kernel.cpp alone.
#pragma once

#include "synth/picture/raster_wide.hpp"

namespace viaface::raster::VIAFACE_KERNEL {
namespace {

// Weights of two by two texels: twice as bytes the left and the right one's, kAcross in all,
// and as half words the upper and the lower row's, kDown in all.
struct Blend {
    static constexpr std::int32_t kAcross = 127, kDown = 256;
    std::int32_t across, down;
};

// Two texels of eight bytes side by side above two others: their weighted sums byte by byte.
VIAFACE_INLINE EightInt blended(const std::uint8_t* upper, const std::uint8_t* lower, const Blend& weights) {
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
    return EightInt(_mm256_inserti128_si256(
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
    EightInt sums;
    for (int i = 0; i < 8; ++i)
        sums[i] = (upper[i] * left + upper[i + 8] * right) * above +
                  (lower[i] * left + lower[i + 8] * right) * below;
    return sums;
#endif
}

}  // namespace
}  // namespace viaface::raster::VIAFACE_KERNEL
