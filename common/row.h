// Eight numbers at once. GCC and Clang know vectors of any machine: with AVX a row is one register, with SSE
// or NEON two, and elsewhere eight plain numbers.
#pragma once

#include <cstdint>

#ifdef __SSE__
#include <xmmintrin.h>
#endif
#ifdef __AVX__
#include <immintrin.h>
#endif

namespace rt {

inline constexpr int lanes = 8;

using Row = float __attribute__((vector_size(4 * lanes)));
using RowOfDoubles = double __attribute__((vector_size(8 * lanes)));
using Mask =
    std::int32_t __attribute__((vector_size(4 * lanes))); ///< what comparing rows gives: -1 or 0 a lane

inline Row row(float value) {
    return value - Row{}; // not plus, which would have to turn -0 into 0
}

/// Lane by lane. Where one of the two is not a number, it is the second: put the one that must survive last.
inline Row least(Row a, Row b) {
    return a < b ? a : b;
}
inline Row greatest(Row a, Row b) {
    return a > b ? a : b;
}

/// c - a b, rounded once where the machine can, and twice elsewhere.
inline Row negative_multiply_add(Row a, Row b, Row c) {
#ifdef __FMA__
    return Row(_mm256_fnmadd_ps(__m256(a), __m256(b), __m256(c)));
#else
    return c - a * b;
#endif
}

/// Bit i is set where lane i holds.
inline unsigned bits(Mask mask) {
#if defined(__AVX__)
    return unsigned(_mm256_movemask_ps(__m256(mask)));
#elif defined(__SSE__)
    __m128 halves[2];
    __builtin_memcpy(halves, &mask, sizeof mask);
    return unsigned(_mm_movemask_ps(halves[0])) | unsigned(_mm_movemask_ps(halves[1])) << 4;
#else
    unsigned all = 0;
    for (int i = 0; i < lanes; ++i) all |= unsigned(mask[i] & 1 << i);
    return all;
#endif
}

} // namespace rt
