// What the checks of step 03 share: oblique directions, and what a wrong value usually means.
#pragma once

#include "common/random.h"
#include "tests/check.h"

#include <string>
#include <utility>
#include <vector>

namespace rt {

/// What a wrong value usually means: the first of `causes` whose value came.
inline std::string hint(vec3 got, const std::vector<std::pair<vec3, std::string>>& causes) {
    for (const auto& [value, cause] : causes)
        if (got == approx(value, 1e-4f)) return "got " + to_text(got) + ": " + cause;
    return "got " + to_text(got);
}

/// A direction of length 1, each as likely as any other.
inline vec3 any_direction(Random& random) {
    const float y = 1 - 2 * random.uniform();
    const float angle = 2 * pi * random.uniform();
    const float r = std::sqrt(std::max(0.0f, 1 - y * y));
    return {r * std::cos(angle), y, r * std::sin(angle)};
}

/// A point of the cube [-size, size]^3.
inline vec3 any_point(Random& random, float size) {
    const float x = random.uniform(), y = random.uniform(), z = random.uniform();
    return size * (2.0f * vec3(x, y, z) - 1.0f);
}

/// Any vector at a right angle to `direction`, of length 1.
inline vec3 beside(vec3 direction) {
    const vec3 other = std::abs(direction.x) < 0.6f ? vec3(1, 0, 0) : vec3(0, 1, 0);
    return normalize(cross(direction, other));
}

/// Oblique on purpose: no vector of it lies along an axis or has unit length by chance.
inline const vec3 tilted = vec3(2, 3, 6) / 7.0f;
inline const vec3 slanting(1.5f, -2, -1);
inline const vec3 somewhere(1, -2, 3);

} // namespace rt
