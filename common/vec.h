// Vectors and constants, under the names that every file of the project uses.
#pragma once

#include <glm/glm.hpp>

namespace rt {

using glm::vec2;
using glm::vec3;

inline constexpr float pi = 3.14159265358979f;
inline constexpr float infinity = std::numeric_limits<float>::infinity();

} // namespace rt
