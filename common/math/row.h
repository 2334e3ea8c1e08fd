// Rows: as many numbers as one register of the machine holds, computed with at once. GCC and Clang know vectors of
// any machine: sixteen floats with AVX-512, eight with AVX, four with SSE or NEON. Elsewhere four are plain numbers.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#ifdef __SSE__
#include <immintrin.h>
#endif

namespace rt {

#if defined(__AVX512F__)
inline constexpr int lanes = 16;
#elif defined(__AVX__)
inline constexpr int lanes = 8;
#else
inline constexpr int lanes = 4;
#endif

using Row = float __attribute__((vector_size(4 * lanes)));
using IntRow =
    std::int32_t __attribute__((vector_size(4 * lanes))); ///< what comparing rows gives: -1 or 0 a lane

inline Row row(float value) {
    return value - Row{}; // not plus, which would have to turn -0 into 0
}

/// Lane by lane, of rows and of shorter ones. Where one of the two is not a number, it is the second: put the one that
/// must survive last.
template <typename Numbers>
Numbers least(Numbers a, Numbers b) {
    return a < b ? a : b;
}
template <typename Numbers>
Numbers greatest(Numbers a, Numbers b) {
    return a > b ? a : b;
}

/// c - a b, rounded once where the machine can, and twice elsewhere.
inline Row negative_multiply_add(Row a, Row b, Row c) {
#if defined(__AVX512F__)
    return Row(_mm512_fnmadd_ps(__m512(a), __m512(b), __m512(c)));
#elif defined(__FMA__)
    return Row(_mm256_fnmadd_ps(__m256(a), __m256(b), __m256(c)));
#else
    return c - a * b;
#endif
}

/// Bit i is set where lane i holds.
inline unsigned bits(IntRow mask) {
#if defined(__AVX512F__)
    return _mm512_test_epi32_mask(__m512i(mask), __m512i(mask));
#elif defined(__AVX__)
    return unsigned(_mm256_movemask_ps(__m256(mask)));
#elif defined(__SSE__)
    return unsigned(_mm_movemask_ps(__m128(mask)));
#else
    unsigned all = 0;
    for (int i = 0; i < lanes; ++i) all |= unsigned(mask[i] & 1 << i);
    return all;
#endif
}

/// bits(a < b) and bits(a <= b). AVX-512 compares into bits; a mask would be a way there and back.
inline unsigned less(Row a, Row b) {
#ifdef __AVX512F__
    return _mm512_cmp_ps_mask(__m512(a), __m512(b), _CMP_LT_OQ);
#else
    return bits(a < b);
#endif
}
inline unsigned at_most(Row a, Row b) {
#ifdef __AVX512F__
    return _mm512_cmp_ps_mask(__m512(a), __m512(b), _CMP_LE_OQ);
#else
    return bits(a <= b);
#endif
}

/// Takes the lowest bit out of `mask` and answers its number.
inline std::size_t next_lane(unsigned& mask) {
    const int lane = std::countr_zero(mask);
    mask &= mask - 1;
    return std::size_t(lane);
}

} // namespace rt
