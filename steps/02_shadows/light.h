// A point light, what it sheds on a surface, and the shadow of whatever stands between.
#pragma once

#include "01_spheres/background.h"
#include "01_spheres/diffuse.h"
#include "02_shadows/offset.h"

namespace rt {

struct PointLight {
    vec3 position;
    vec3 intensity; ///< W/sr, the same in all directions: a power of 4 pi intensity
};

/// A scene that can also tell, sooner than it finds the nearest hit, whether there is any.
template <typename Scene>
concept CastsShadows = Traceable<Scene> && requires(const Scene& scene, const Ray& ray) {
    { occluded(scene, ray) } -> std::same_as<bool>;
};

/// What a surface at `position` with this unit normal receives of the light if nothing stands between, W/m^2:
/// E = I cos(theta) / r^2, and nothing from behind.
inline vec3 irradiance(const PointLight& light, vec3 position, vec3 normal) {
    //> the cosine to the normal, over the square of the distance
    const vec3 to_light = light.position - position;
    const float squared = dot(to_light, to_light);
    if (squared == 0) return vec3(0); // the lamp itself
    const float cosine = dot(to_light, normal) / std::sqrt(squared);
    return light.intensity * glm::max(cosine, 0.0f) / squared;
    //< return vec3(1);
}

/// The irradiance at a hit from all point lights that it sees. Shortcut: between the two the air is clear,
/// even within coloured glass.
template <CastsShadows S>
vec3 direct_light(const S& scene, const Hit& hit) {
    vec3 sum(0);
    for (const PointLight& light : scene.lights) {
        const vec3 arriving = irradiance(light, hit.position, hit.normal);
        //> add it if it is any, and if nothing stands between the hit and the light
        if (arriving != vec3(0) && !occluded(scene, segment_to(hit, light.position))) sum += arriving;
        //< sum += arriving;
    }
    return sum;
}

/// The radiance of a matte surface in the light of the point lights and of the sky. Shortcut: nothing stands
/// in the sky's way, which makes it a stand-in for indirect light until step 08.
template <CastsShadows S>
vec3 lit(const S& scene, const Hit& hit, const Diffuse& diffuse) {
    return reflected(diffuse, hit.tint * (direct_light(scene, hit) + irradiance(scene.sky, hit.normal)));
}

} // namespace rt
