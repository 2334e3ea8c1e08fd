// SIMD vectors: as many numbers as a register of the machine holds, computed with one instruction.
// GCC and Clang provide vectors for every machine: 16 floats with AVX-512, 8 with AVX, 4 with SSE or
// NEON; elsewhere 4 scalars. With RAYSTEPS_ROWS=plain, the 4 lanes of plain_simd.h.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#ifdef RT_PLAIN_ROWS
#include "accel/plain_simd.h"
#define RT_REGISTER 0 // its bits
#elif defined(__AVX512F__)
#define RT_REGISTER 512
#elif defined(__AVX__)
#define RT_REGISTER 256
#else
#define RT_REGISTER 128
#endif
#if defined(__SSE__)
#include <immintrin.h>
#elif defined(__wasm_simd128__)
#include <wasm_simd128.h>
#endif

namespace rt::accel {

#if RT_REGISTER == 0
inline constexpr int simd_width = 4;

using FloatN = Lanes<float, simd_width>;
using IntN = Lanes<std::int32_t, simd_width>; ///< a comparison gives -1 or 0 per lane

using Float4 = FloatN;
using Int4 = IntN;
#else
inline constexpr int simd_width = RT_REGISTER / 32;

using FloatN = float __attribute__((vector_size(4 * simd_width)));
using IntN =
    std::int32_t __attribute__((vector_size(4 * simd_width))); ///< a comparison gives -1 or 0 per lane

using Float4 = float __attribute__((vector_size(16)));
using Int4 = std::int32_t __attribute__((vector_size(16)));

/// Returns lanes of `a` where the mask is set, and of `b` elsewhere.
template <typename Mask, typename Vector>
Vector select(Mask mask, Vector a, Vector b) {
    return mask ? a : b;
}

/// Returns the whole numbers towards zero.
inline Int4 truncated(Float4 numbers) {
    return __builtin_convertvector(numbers, Int4);
}
#endif

/// Returns `value` in every lane.
inline FloatN broadcast(float value) {
    return value - FloatN{}; // not plus, which would have to turn -0 into 0
}

/// Per lane, of vectors of any width. If one operand is NaN, the result is the second: pass the one
/// that must survive last.
template <typename Vector>
Vector min(Vector a, Vector b) {
    return select(a < b, a, b);
}
template <typename Vector>
Vector max(Vector a, Vector b) {
    return select(a > b, a, b);
}

/// Returns c - a b, rounded once if the machine can fuse the two operations, otherwise twice.
inline FloatN fnmadd(FloatN a, FloatN b, FloatN c) {
#if RT_REGISTER == 512
    return FloatN(_mm512_fnmadd_ps(__m512(a), __m512(b), __m512(c)));
#elif RT_REGISTER == 256 && defined(__FMA__)
    return FloatN(_mm256_fnmadd_ps(__m256(a), __m256(b), __m256(c)));
#else
    return c - a * b;
#endif
}

/// Returns one bit per lane: bit i is set if lane i of the mask is.
inline unsigned movemask(IntN mask) {
#if RT_REGISTER == 512
    return _mm512_test_epi32_mask(__m512i(mask), __m512i(mask));
#elif RT_REGISTER == 256
    return unsigned(_mm256_movemask_ps(__m256(mask)));
#elif RT_REGISTER == 128 && defined(__SSE__)
    return unsigned(_mm_movemask_ps(__m128(mask)));
#elif defined(__wasm_simd128__)
    return wasm_i32x4_bitmask(v128_t(mask));
#else
    unsigned all = 0;
    for (int i = 0; i < simd_width; ++i) all |= unsigned(mask[i] & 1 << i);
    return all;
#endif
}

/// movemask(a < b) and movemask(a <= b). AVX-512 compares into bits directly.
inline unsigned less(FloatN a, FloatN b) {
#if RT_REGISTER == 512
    return _mm512_cmp_ps_mask(__m512(a), __m512(b), _CMP_LT_OQ);
#else
    return movemask(a < b);
#endif
}
inline unsigned less_equal(FloatN a, FloatN b) {
#if RT_REGISTER == 512
    return _mm512_cmp_ps_mask(__m512(a), __m512(b), _CMP_LE_OQ);
#else
    return movemask(a <= b);
#endif
}

/// Removes the lowest bit from `mask` and returns its index.
inline std::size_t pop_lowest_bit(unsigned& mask) {
    const int bit = std::countr_zero(mask);
    mask &= mask - 1;
    return std::size_t(bit);
}

} // namespace rt::accel
