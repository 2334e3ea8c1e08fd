// What the checks of step 03 share beside those of step 01: oblique directions, and what a wrong value usually means.
#pragma once

#include "tests/01_spheres/step.h"

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

/// Oblique on purpose: no vector of it lies along an axis or has unit length by chance.
inline const vec3 tilted = vec3(2, 3, 6) / 7.0f;
inline const vec3 slanting(1.5f, -2, -1);
inline const vec3 somewhere(1, -2, 3);

} // namespace rt
