// Smooth noise in space, for irregular shapes: borders of spots, coastlines, sand.
#pragma once

#include "assets/mesh.h"

#include <cmath>
#include <cstdint>

namespace rt::assets {

/// Returns a vector in [-1, 1]^3 for a point of the integer lattice, by 32-bit mixing
/// (the finaliser of MurmurHash3).
inline dvec3 lattice_vector(ivec3 at) {
    const glm::uvec3 spread = glm::uvec3(at) * glm::uvec3(73856093u, 19349663u, 83492791u);
    std::uint32_t bits = spread.x ^ spread.y ^ spread.z;
    bits = (bits ^ (bits >> 16)) * 0x85ebca6bu;
    bits = (bits ^ (bits >> 13)) * 0xc2b2ae35u;
    bits ^= bits >> 16;
    return dvec3(bits & 1023, (bits >> 10) & 1023, (bits >> 20) & 1023) / 511.5 - 1.0;
}

/// Gradient noise (Perlin 1985): each corner of a cell has its own gradient, and they are blended with
/// weights 3 t^2 - 2 t^3. Smooth, about -1 to 1, with features about one unit wide.
inline double noise(dvec3 point) {
    const dvec3 cell = glm::floor(point);
    const dvec3 weight = glm::smoothstep(dvec3(0), dvec3(1), point - cell);
    double sum = 0;
    for (int corner = 0; corner < 8; ++corner) {
        const ivec3 offset(corner & 1, (corner >> 1) & 1, corner >> 2);
        const dvec3 share = mix(1.0 - weight, weight, dvec3(offset));
        const double slope = dot(lattice_vector(ivec3(cell) + offset), point - cell - dvec3(offset));
        sum += share.x * share.y * share.z * slope;
    }
    return 1.5 * sum;
}

/// Returns a sum of octaves, each half the size and half the amplitude of the one before. The
/// shift decorrelates their lattices.
inline double fractal_noise(dvec3 point, int octaves) {
    double sum = 0, height = 0.5;
    for (int octave = 0; octave < octaves; ++octave) {
        sum += height * noise(point);
        point = 2.0 * point + dvec3(17.3, 5.9, 31.7);
        height /= 2;
    }
    return sum;
}

} // namespace rt::assets
