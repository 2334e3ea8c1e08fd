// Vectors and constants, under the names that all files of the project use.
#pragma once

#include <glm/glm.hpp>

#include <cmath>

namespace rt {

using glm::dvec3;
using glm::vec2;
using glm::vec3;

inline constexpr float pi = 3.14159265358979f;
inline constexpr float infinity = std::numeric_limits<float>::infinity();

/// Returns the absolute value of each coordinate. It clears the sign bits, where
/// glm::abs() compares and selects.
inline vec3 abs(vec3 v) {
    return {std::abs(v.x), std::abs(v.y), std::abs(v.z)};
}

} // namespace rt
