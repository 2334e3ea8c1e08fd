// Bounces: where light goes from a matte surface, by chance, and when a path may end.
#pragma once

#include "common/math/random.h"
#include "common/math/vec.h"

#include <cmath>
#include <optional>

namespace rt {

/// Two unit vectors at right angles to the unit `normal` and to each other (Duff et al. 2017, JCGT 6(1)).
struct Tangents {
    vec3 u, v;
};

inline Tangents tangents(vec3 normal) {
    const float sign = std::copysign(1.0f, normal.z);
    const float a = -1 / (sign + normal.z);
    const float b = normal.x * normal.y * a;
    return {{1 + sign * normal.x * normal.x * a, sign * b, -sign * normal.x},
            {b, sign + normal.y * normal.y * a, -normal.y}};
}

/// A unit direction above the surface, likelier the closer to the unit normal: density cos(theta) / pi. A
/// uniform point of the unit disk is lifted onto the half-sphere above it (Malley; Pharr, Jakob, Humphreys,
/// PBR, 3rd edition, 13.6.3). u in [0, 1)^2.
inline vec3 cosine_direction(vec3 normal, vec2 u) {
    //> radius sqrt(u.x) and an angle make the point of the disk; Pythagoras makes its height
    const float radius = std::sqrt(u.x);
    const float angle = 2 * pi * u.y;
    const auto [right, up] = tangents(normal);
    const vec3 flat = radius * (std::cos(angle) * right + std::sin(angle) * up);
    return flat + std::sqrt(1 - u.x) * normal;
    //< return normal;
}

/// The density of cosine_direction(), 1/sr; `cosine` is that of the angle to the normal.
inline float cosine_pdf(float cosine) {
    return glm::max(cosine, 0.0f) / pi;
}

/// Unit vectors towards all sides, evenly (Archimedes: slices of equal height have equal area). u in [0,
/// 1)^2.
inline vec3 unit_vector(vec2 u) {
    const float z = 1 - 2 * u.x;
    const float radius = std::sqrt(glm::max(0.0f, 1 - z * z));
    return {radius * std::cos(2 * pi * u.y), radius * std::sin(2 * pi * u.y), z};
}

/// How the bounces of a matte surface are spread over the directions above it: by the cosine, or evenly.
enum class Spread { cosine, uniform };

/// A direction above the surface. u in [0, 1)^2.
inline vec3 bounce_direction(Spread spread, vec3 normal, vec2 u) {
    if (spread == Spread::cosine) return cosine_direction(normal, u);
    const vec3 direction = unit_vector(u);
    return dot(direction, normal) < 0 ? -direction : direction;
}

/// The density of bounce_direction(), 1/sr; `cosine` is that of the angle to the normal.
inline float bounce_pdf(Spread spread, float cosine) {
    if (spread == Spread::cosine) return cosine_pdf(cosine);
    return cosine < 0 ? 0 : 1 / (2 * pi);
}

/// Russian roulette: a path that carries little goes on with a probability in proportion, and what goes on is
/// weighed up by 1 / probability, so the mean stays (Arvo and Kirk 1990). Answers the new throughput, or
/// nothing if the path ends.
template <UniformSource Source>
std::optional<vec3> roulette(vec3 throughput, Source& source) {
    //> survive with the largest component, at most .95, and divide by it
    const float largest = glm::max(throughput.x, glm::max(throughput.y, throughput.z));
    const float survival = glm::min(largest, 0.95f);
    if (source.uniform() >= survival) return std::nullopt;
    return throughput / survival;
    //< return throughput;
}

} // namespace rt
