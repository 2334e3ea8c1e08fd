// Sampling directions over a hemisphere, cosine-weighted or uniform, and their densities.
#pragma once

#include "common/math/vec.h"

#include <cmath>

namespace rt {

/// Two unit vectors perpendicular to the unit `normal` and to each other (Duff et al. 2017, JCGT 6(1)).
struct OrthonormalBasis {
    vec3 u, v;
};

inline OrthonormalBasis make_basis(vec3 normal) {
    const float sign = std::copysign(1.0f, normal.z);
    const float a = -1 / (sign + normal.z);
    const float b = normal.x * normal.y * a;
    return {{1 + sign * normal.x * normal.x * a, sign * b, -sign * normal.x},
            {b, sign + normal.y * normal.y * a, -normal.y}};
}

/// Samples a unit direction with density cos(theta) / pi about the unit normal: a uniform point of the unit
/// disk is projected up onto the hemisphere (Malley; Pharr, Jakob, Humphreys, PBR, 3rd edition, 13.6.3). u in
/// [0, 1)^2.
inline vec3 sample_cosine_hemisphere(vec3 normal, vec2 u) {
    //> how does a point spread evenly over a disk become a direction whose density is cos / pi?
    const float radius = std::sqrt(u.x);
    const float angle = 2 * pi * u.y;
    const auto [right, up] = make_basis(normal);
    const vec3 on_disk = radius * (std::cos(angle) * right + std::sin(angle) * up);
    return on_disk + std::sqrt(1 - u.x) * normal;
    //< return normal;
}

/// Returns the density of sample_cosine_hemisphere(), 1/sr; `cosine` is that of the angle to the normal.
inline float cosine_hemisphere_pdf(float cosine) {
    return glm::max(cosine, 0.0f) / pi;
}

/// Samples the unit sphere uniformly (Archimedes: slices of equal height have equal area). u in [0, 1)^2.
inline vec3 sample_uniform_sphere(vec2 u) {
    const float z = 1 - 2 * u.x;
    const float radius = std::sqrt(glm::max(0.0f, 1 - z * z));
    return {radius * std::cos(2 * pi * u.y), radius * std::sin(2 * pi * u.y), z};
}

/// Density from which bounce directions are drawn: cosine-weighted or uniform over the hemisphere.
enum class HemisphereSampling { cosine, uniform };

/// Samples a unit direction above the surface. u in [0, 1)^2.
inline vec3 sample_hemisphere(HemisphereSampling sampling, vec3 normal, vec2 u) {
    if (sampling == HemisphereSampling::cosine) return sample_cosine_hemisphere(normal, u);
    const vec3 direction = sample_uniform_sphere(u);
    return dot(direction, normal) < 0 ? -direction : direction;
}

/// Returns the density of sample_hemisphere(), 1/sr; `cosine` is that of the angle to the normal.
inline float hemisphere_pdf(HemisphereSampling sampling, float cosine) {
    if (sampling == HemisphereSampling::cosine) return cosine_hemisphere_pdf(cosine);
    return cosine < 0 ? 0 : 1 / (2 * pi);
}

} // namespace rt
