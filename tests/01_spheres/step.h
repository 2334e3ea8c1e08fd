// What the checks of step 01 share: what a wrong value means, directions and points.
// Included last, so that no name in a learner's header hides one of these.
#pragma once

#include "tests/check.h"
#include "common/math/random.h"

#include <initializer_list>
#include <optional>

namespace rt {

/// The t of a hit; NaN, which equals nothing, for a miss.
inline float t_of(const std::optional<float>& t) {
    return t.value_or(std::numeric_limits<float>::quiet_NaN());
}

/// A value that a mistake makes, and which mistake that is.
struct Cause {
    float value;
    const char* text;
};

/// What a wrong value usually means: the first of `causes` whose value came.
inline std::string hint(float got, std::initializer_list<Cause> causes) {
    for (const auto& [value, cause] : causes)
        if (got == approx(value, 1e-3f) || (std::isnan(got) && std::isnan(value)))
            return "got " + to_text(got) + ": " + cause;
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

/// What t_of answers for a miss.
inline constexpr float miss = std::numeric_limits<float>::quiet_NaN();

inline constexpr float degrees = pi / 180;

} // namespace rt
