// Vectors and constants, under the names that every file of the project uses.
#pragma once

#include <glm/glm.hpp>

#include <cmath>

namespace rt {

using glm::dvec3;
using glm::vec2;
using glm::vec3;

inline constexpr float pi = 3.14159265358979f;
inline constexpr float infinity = std::numeric_limits<float>::infinity();

/// The size of each coordinate; glm::abs() compares and chooses where clearing the sign bits does.
inline vec3 abs(vec3 v) {
    return {std::abs(v.x), std::abs(v.y), std::abs(v.z)};
}

} // namespace rt
