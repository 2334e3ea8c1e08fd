// Scenes for the checks of step 06: uniformly lit, and seen from above.
#pragma once

#include "04_refraction/radiance.h"
#include "06_textures/scene.h"
#include "tests/06_textures/step.h"

namespace rt {

/// Builds a scene under a sky of irradiance pi, so that the radiance of a matte surface is its albedo.
inline Scene evenly_lit() {
    Scene scene;
    scene.sky = {vec3(1), vec3(1)};
    return scene;
}

/// Returns the radiance seen at (x, y) from straight above, with z up.
inline vec3 seen_at(const Scene& scene, float x, float y) {
    return radiance(scene, Ray{{x, y, 5}, {0, 0, -2}}, 4);
}

} // namespace rt
