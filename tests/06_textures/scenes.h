// Scenes for the checks of step 06: evenly lit, and seen from above.
#pragma once

#include "04_refraction/radiance.h"
#include "06_textures/scene.h"
#include "tests/06_textures/step.h"

namespace rt {

/// A scene under a sky that makes E = pi everywhere, so that the radiance of a matte surface is its albedo.
inline Scene evenly_lit() {
    Scene scene;
    scene.sky = {vec3(1), vec3(1)};
    return scene;
}

/// What the eye sees of the scene from straight above at (x, y), with z up.
inline vec3 seen_at(const Scene& scene, float x, float y) {
    return radiance(scene, Ray{{x, y, 5}, {0, 0, -2}}, 4);
}

} // namespace rt
