// How light travels, in step 03: mirrors recurse, up to a maximum depth.
#pragma once

#include "02_shadows/point_light.h"
#include "03_mirror/mirror.h"
#include "common/util/match.h"

namespace rt {

template <Occludable S>
vec3 radiance(const S& scene, const Ray& ray, int bounces_left);

/// Shades the hit with `scene.materials[material]`.
template <Occludable S>
vec3 shade(const S& scene, const Ray& ray, const Hit& hit, int material, int bounces_left) {
    //> which light comes along the reflected ray? Remember that this must end
    const auto trace_reflected = [&] { return radiance(scene, reflected_ray(ray, hit), bounces_left - 1); };
    //< const auto trace_reflected = [&] { return vec3(0); };
    return match(
        scene.materials[std::size_t(material)],
        [&](const auto& matte) { return shade_diffuse(scene, hit, matte_at(matte, scene, hit)); },
        [&](const Mirror& mirror) { return mirror.reflectance * trace_reflected(); },
        [&](const Coated& coat) {
            return mix(shade(scene, ray, hit, coat.base, bounces_left), coat.reflectance * trace_reflected(),
                       coat.reflectivity);
        });
}

/// Returns the radiance arriving along the ray, W / (m^2 sr), linear RGB. `bounces_left` is how many more
/// mirrors it may hit; light beyond the last one is left out, so the result is never too bright.
template <Occludable S>
vec3 radiance(const S& scene, const Ray& ray, int bounces_left) {
    if (bounces_left < 0) return vec3(0);
    const auto hit = intersect(scene, ray);
    if (!hit) return radiance(scene.sky, ray.direction);
    return shade(scene, ray, *hit, hit->material, bounces_left);
}

} // namespace rt
