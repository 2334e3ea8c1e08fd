// What the checks of step 02 share to cast shadows: a scene of lights and balls.
// Include it last, so that no name in a learner's header hides one of these.
#pragma once

#include "02_shadows/scene.h"

#include <utility>
#include <vector>

namespace rt {

/// Builds a scene of `lights` and matte grey `balls` only.
inline Scene lit_balls(std::vector<PointLight> lights, std::vector<Sphere> balls) {
    Scene scene;
    add(scene.materials, Diffuse{vec3(0.5f)});
    scene.lights = std::move(lights);
    scene.spheres = std::move(balls);
    return scene;
}

} // namespace rt
