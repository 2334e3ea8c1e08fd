// What the checks of step 02 need to cast shadows: a scene of lights and balls.
// Included last, so that no name in a learner's header hides one of these.
#pragma once

#include "02_shadows/scene.h"

#include <utility>
#include <vector>

namespace rt {

/// A scene of nothing but `lights` and `balls` of matte grey.
inline Scene lit_balls(std::vector<PointLight> lights, std::vector<Sphere> balls) {
    Scene scene;
    add(scene.materials, Diffuse{vec3(0.5f)});
    scene.lights = std::move(lights);
    scene.spheres = std::move(balls);
    return scene;
}

} // namespace rt
