// A point light: the irradiance it gives to a surface, and its shadows.
#pragma once

#include "01_spheres/diffuse.h"
#include "01_spheres/sky.h"
#include "02_shadows/spawn_ray.h"

namespace rt {

struct PointLight {
    vec3 position;
    vec3 intensity; ///< W/sr, the same in all directions: a power of 4 pi intensity
};

/// A scene that also answers the cheaper any-hit query used by shadow rays.
template <typename Scene>
concept Occludable = Traceable<Scene> && requires(const Scene& scene, const Ray& ray) {
    { occluded(scene, ray) } -> std::same_as<bool>;
};

/// Returns the unoccluded irradiance from the light at `position` on a surface with this unit normal, W/m^2:
/// E = I cos(theta) / r^2, and 0 from behind.
inline vec3 irradiance(const PointLight& light, vec3 position, vec3 normal) {
    //> how do the distance and the angle of the light weaken what arrives?
    const vec3 to_light = light.position - position;
    const float distance_squared = dot(to_light, to_light);
    if (distance_squared == 0) return vec3(0); // the light itself
    const float cosine = dot(to_light, normal) / std::sqrt(distance_squared);
    return light.intensity * glm::max(cosine, 0.0f) / distance_squared;
    //< return vec3(1);
}

/// Returns the irradiance at a hit from all point lights that are visible from it, W/m^2. Shortcut: no medium
/// absorbs light on the way, not even coloured glass.
template <Occludable S>
vec3 direct_irradiance(const S& scene, const Hit& hit) {
    vec3 sum(0);
    for (const PointLight& light : scene.lights) {
        const vec3 unoccluded = irradiance(light, hit.position, hit.shading_normal);
        //> does this light reach the hit?
        if (unoccluded != vec3(0) && !occluded(scene, spawn_ray_to(hit, light.position))) sum += unoccluded;
        //< sum += unoccluded;
    }
    return sum;
}

/// Returns the radiance of a diffuse surface lit by the point lights and the sky. Shortcut: the sky is never
/// occluded; it stands in for indirect light until step 08.
template <Occludable S>
vec3 shade_diffuse(const S& scene, const Hit& hit, const Diffuse& diffuse) {
    return outgoing_radiance(diffuse, hit.vertex_color * (direct_irradiance(scene, hit) +
                                                          irradiance(scene.sky, hit.shading_normal)));
}

} // namespace rt
