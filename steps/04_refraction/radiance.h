// How light travels, in step 04: glass splits a ray into a reflected and a refracted one; media absorb.
#pragma once

#include "02_shadows/point_light.h"
#include "03_mirror/mirror.h"
#include "04_refraction/dielectric.h"
#include "common/util/match.h"

namespace rt {

template <Occludable S>
vec3 radiance(const S& scene, const Ray& ray, int bounces_left, vec3 absorption = vec3(0));

/// Shades the hit with `scene.materials[material]`.
template <Occludable S>
vec3 shade(const S& scene, const Ray& ray, const Hit& hit, int material, int bounces_left, vec3 absorption) {
    const auto trace_reflected = [&] {
        return radiance(scene, reflected_ray(ray, hit), bounces_left - 1, absorption);
    };
    return match(
        scene.materials[std::size_t(material)],
        [&](const auto& matte) { return shade_diffuse(scene, hit, matte_at(matte, scene, hit)); },
        [&](const Mirror& mirror) { return mirror.reflectance * trace_reflected(); },
        [&](const Coated& coat) {
            return mix(shade(scene, ray, hit, coat.base, bounces_left, absorption),
                       coat.reflectance * trace_reflected(), coat.reflectivity);
        },
        [&](const Dielectric& dielectric) {
            const Interface interface = make_interface(dielectric, ray, hit);
            const vec3 reflected = interface.reflectance * trace_reflected();
            const auto refracted = refracted_ray(ray, hit, interface);
            if (!refracted) return reflected;
            const vec3 transmitted = radiance(scene, *refracted, bounces_left - 1,
                                              interface.transmitted_medium.absorption_coefficient);
            return reflected + (1 - interface.reflectance) * transmitted;
        });
}

/// Returns the radiance arriving along the ray, W / (m^2 sr), linear RGB. `bounces_left` is how many more
/// mirrors and interfaces it may hit; light beyond the last one is left out, so the result is never too
/// bright. `absorption` is that of the medium the ray travels in. In a medium of index n the result is the
/// basic radiance L / n^2, which refraction does not change (Nicodemus 1963). Shortcut: glass casts a full
/// shadow.
template <Occludable S>
vec3 radiance(const S& scene, const Ray& ray, int bounces_left, vec3 absorption) {
    if (bounces_left < 0) return vec3(0);
    const auto hit = intersect(scene, ray);
    if (!hit) return absorption == vec3(0) ? radiance(scene.sky, ray.direction) : vec3(0);
    const float distance = hit->t * length(ray.direction);
    return transmittance(absorption, distance) *
           shade(scene, ray, *hit, hit->material, bounces_left, absorption);
}

} // namespace rt
