// How light travels, in step 04: at glass it takes both ways, and on its way it is absorbed.
#pragma once

#include "02_shadows/light.h"
#include "03_mirror/mirror.h"
#include "04_refraction/glass.h"
#include "common/util/match.h"

namespace rt {

template <CastsShadows S>
vec3 radiance(const S& scene, const Ray& ray, int depth, vec3 absorption = vec3(0));

/// What material number `material` makes of the hit.
template <CastsShadows S>
vec3 shade(const S& scene, const Ray& ray, const Hit& hit, int material, int depth, vec3 absorption) {
    const auto mirrored = [&] { return radiance(scene, mirror_ray(ray, hit), depth - 1, absorption); };
    return match(
        scene.materials[std::size_t(material)],
        [&](const auto& matte) { return lit(scene, hit, matte_at(matte, scene, hit)); },
        [&](const Mirror& mirror) { return mirror.tint * mirrored(); },
        [&](const Reflective& coat) {
            return mix(shade(scene, ray, hit, coat.base, depth, absorption), coat.tint * mirrored(),
                       coat.reflectivity);
        },
        [&](const Glass& glass) {
            const Boundary side = boundary(glass, ray, hit);
            const vec3 reflected = side.reflectance * mirrored();
            const auto onward = refracted_ray(ray, hit, side);
            if (!onward) return reflected;
            const vec3 beyond = radiance(scene, *onward, depth - 1, side.beyond.absorption);
            return reflected + (1 - side.reflectance) * beyond;
        });
}

/// The radiance that comes back along the ray, W / (m^2 sr), linear RGB. `depth` is how many more mirrors and
/// glass boundaries it may meet; the light beyond the last one is left out, so that the answer is never too
/// bright. `absorption` is that of the medium the ray travels in. Within a medium of index n the answer is
/// the basic radiance L / n^2, which refraction leaves as it is (Nicodemus 1963). Shortcut: glass casts a
/// full shadow.
template <CastsShadows S>
vec3 radiance(const S& scene, const Ray& ray, int depth, vec3 absorption) {
    if (depth < 0) return vec3(0);
    const auto hit = intersect(scene, ray);
    if (!hit) return absorption == vec3(0) ? radiance(scene.sky, ray.direction) : vec3(0);
    const float distance = hit->t * length(ray.direction);
    return transmittance(absorption, distance) * shade(scene, ray, *hit, hit->material, depth, absorption);
}

} // namespace rt
