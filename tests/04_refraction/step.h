// What the checks of step 04 share: an oblique boundary, and directions that arrive at it.
#pragma once

#include "tests/check.h"

namespace rt {

inline const vec3 normal = vec3(2, -1, 2) / 3.0f;            // oblique, of unit length,
inline const vec3 tangent = vec3(1, 2, 0) / std::sqrt(5.0f); // and two perpendicular vectors
inline const vec3 binormal = vec3(-4, 2, 5) / std::sqrt(45.0f);

inline float cosine(float degrees) {
    return std::cos(glm::radians(degrees));
}

/// Returns a direction of length 2 that arrives at this angle to `normal`, degrees.
inline vec3 arriving(float degrees) {
    return 2.0f * (std::sin(glm::radians(degrees)) * tangent - cosine(degrees) * normal);
}

} // namespace rt
