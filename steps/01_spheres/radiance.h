// How light travels, in step 01: from the sky to the first surface, and from there to the eye.
#pragma once

#include "01_spheres/diffuse.h"
#include "01_spheres/hit.h"
#include "01_spheres/sky.h"
#include "common/util/match.h"

namespace rt {

/// Returns the radiance of a diffuse surface lit by the whole sky. Shortcut: the sky is never occluded. Step
/// 02 adds shadows; in step 08 the surroundings occlude the sky and reflect light themselves.
template <Traceable S>
vec3 shade_diffuse(const S& scene, const Hit& hit, const Diffuse& diffuse) {
    return outgoing_radiance(diffuse, irradiance(scene.sky, hit.shading_normal));
}

/// Returns the radiance arriving along the ray, W / (m^2 sr), linear RGB.
template <Traceable S>
vec3 radiance(const S& scene, const Ray& ray) {
    const auto hit = intersect(scene, ray);
    if (!hit) return radiance(scene.sky, ray.direction);
    return match(scene.materials[std::size_t(hit->material)],
                 [&](const auto& matte) { return shade_diffuse(scene, *hit, matte_at(matte, scene, *hit)); });
}

} // namespace rt
