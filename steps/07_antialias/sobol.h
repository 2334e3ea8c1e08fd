// Sobol points, a low-discrepancy sequence: the first 2^k points have one in every elementary box of area
// 2^-k.
#pragma once

#include "common/math/random.h"

namespace rt {

constexpr std::uint32_t reverse_bits(std::uint32_t bits) {
    bits = (bits << 16) | (bits >> 16);
    bits = (bits & 0x00ff00ffu) << 8 | (bits & 0xff00ff00u) >> 8;
    bits = (bits & 0x0f0f0f0fu) << 4 | (bits & 0xf0f0f0f0u) >> 4;
    bits = (bits & 0x33333333u) << 2 | (bits & 0xccccccccu) >> 2;
    return (bits & 0x55555555u) << 1 | (bits & 0xaaaaaaaau) >> 1;
}

/// Returns the second coordinate of Sobol point `index` (Sobol 1967), its digits reversed: bit 0 counts 1/2,
/// bit 1 counts 1/4. (The first coordinate, reversed, is `index` itself: van der Corput 1935.) Digit r is the
/// sum mod 2 of C(j, r) times bit j of the index, and C(j, r) is odd where r has no bit that j lacks (Lucas
/// 1878), so five halvings make the whole sum.
constexpr std::uint32_t sobol_dimension_1(std::uint32_t index) {
    //> which bits of the index add up, modulo 2, to each bit of the result?
    index ^= index >> 16;
    index ^= (index & 0xff00ff00u) >> 8;
    index ^= (index & 0xf0f0f0f0u) >> 4;
    index ^= (index & 0xccccccccu) >> 2;
    return index ^ (index & 0xaaaaaaaau) >> 1;
    //< return index;
}

/// Owen's nested scrambling (1995) of reversed digits: whether a bit is flipped depends on the key and the
/// bits below it, so that boxes are mapped to boxes. By sums and products, whose carries only go up: Laine
/// and Karras 2011; for Sobol points Burley 2020 (JCGT 9(4)); these constants Vegdahl 2021.
constexpr std::uint32_t owen_scramble(std::uint32_t reversed, std::uint32_t key) {
    reversed ^= reversed * 0x3d20adeau;
    reversed += key;
    reversed *= (key >> 16) | 1;
    reversed ^= reversed * 0x05526c56u;
    return reversed ^ reversed * 0x53a22864u;
}

/// Returns the number in [0, 1) with these binary digits; 24 of them, all that a float holds, so it is never
/// 1.
constexpr float to_unit_float(std::uint32_t reversed) {
    return float(reverse_bits(reversed) >> 8) * 0x1p-24f;
}

/// Returns Sobol point `index` in [0, 1)^2, both coordinates scrambled by the key.
inline vec2 owen_sobol_2d(std::uint32_t index, std::uint64_t key) {
    return {to_unit_float(owen_scramble(index, std::uint32_t(key))),
            to_unit_float(owen_scramble(sobol_dimension_1(index), std::uint32_t(key >> 32)))};
}

} // namespace rt
