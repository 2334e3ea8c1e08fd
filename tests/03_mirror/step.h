// What the checks of step 03 share in addition to those of step 01: causes of wrong colours, directions.
#pragma once

#include "tests/01_spheres/step.h"

#include <string>
#include <utility>
#include <vector>

namespace rt {

/// Returns what a wrong value usually means: the first of `causes` whose value matches `got`.
inline std::string hint(vec3 got, const std::vector<std::pair<vec3, std::string>>& causes) {
    for (const auto& [value, cause] : causes)
        if (got == approx(value, 1e-4f)) return "got " + to_text(got) + ": " + cause;
    return "got " + to_text(got);
}

/// Deliberately oblique: no vector lies along an axis or has unit length by chance.
inline const vec3 tilted = vec3(2, 3, 6) / 7.0f;
inline const vec3 slanting(1.5f, -2, -1);
inline const vec3 somewhere(1, -2, 3);

} // namespace rt
