// What the checks of step 01 share: causes of wrong values, random directions and points.
// Include it last, so that no name in a learner's header hides one of these.
#pragma once

#include "tests/check.h"
#include "common/math/random.h"

#include <initializer_list>
#include <optional>

namespace rt {

/// Returns the t of a hit, or NaN, which equals nothing, for a miss.
inline float t_of(const std::optional<float>& t) {
    return t.value_or(std::numeric_limits<float>::quiet_NaN());
}

/// A value that a known mistake produces, and the description of the mistake.
struct Cause {
    float value;
    const char* text;
};

/// Returns what a wrong value usually means: the first of `causes` whose value matches `got`.
inline std::string hint(float got, std::initializer_list<Cause> causes) {
    for (const auto& [value, cause] : causes)
        if (got == approx(value, 1e-3f) || (std::isnan(got) && std::isnan(value)))
            return "got " + to_text(got) + ": " + cause;
    return "got " + to_text(got);
}

/// Returns a uniformly distributed direction of unit length.
inline vec3 any_direction(Random& random) {
    const float y = 1 - 2 * random.get_1d();
    const float angle = 2 * pi * random.get_1d();
    const float r = std::sqrt(std::max(0.0f, 1 - y * y));
    return {r * std::cos(angle), y, r * std::sin(angle)};
}

/// Returns a random point of the cube [-size, size]^3.
inline vec3 any_point(Random& random, float size) {
    const float x = random.get_1d(), y = random.get_1d(), z = random.get_1d();
    return size * (2.0f * vec3(x, y, z) - 1.0f);
}

/// Returns some unit vector perpendicular to `direction`.
inline vec3 beside(vec3 direction) {
    const vec3 other = std::abs(direction.x) < 0.6f ? vec3(1, 0, 0) : vec3(0, 1, 0);
    return normalize(cross(direction, other));
}

/// What t_of returns for a miss.
inline constexpr float miss = std::numeric_limits<float>::quiet_NaN();

inline constexpr float degrees = pi / 180;

} // namespace rt
