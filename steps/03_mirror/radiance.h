// How light travels, in step 03: mirrors send the question on, up to a stated number of times.
#pragma once

#include "02_shadows/light.h"
#include "03_mirror/mirror.h"
#include "common/util/match.h"

namespace rt {

template <CastsShadows S>
vec3 radiance(const S& scene, const Ray& ray, int depth);

/// What material number `material` makes of the hit.
template <CastsShadows S>
vec3 shade(const S& scene, const Ray& ray, const Hit& hit, int material, int depth) {
    const auto mirrored = [&] { return radiance(scene, mirror_ray(ray, hit), depth - 1); };
    return match(
        scene.materials[std::size_t(material)],
        [&](const auto& matte) { return lit(scene, hit, matte_at(matte, scene, hit)); },
        [&](const Mirror& mirror) { return mirror.tint * mirrored(); },
        [&](const Reflective& coat) {
            return mix(shade(scene, ray, hit, coat.base, depth), coat.tint * mirrored(), coat.reflectivity);
        });
}

/// The radiance that comes back along the ray, W / (m^2 sr), linear RGB. `depth` is how many more mirrors it
/// may meet; the light beyond the last one is left out, so that the answer is never too bright.
template <CastsShadows S>
vec3 radiance(const S& scene, const Ray& ray, int depth) {
    if (depth < 0) return vec3(0);
    const auto hit = intersect(scene, ray);
    if (!hit) return radiance(scene.sky, ray.direction);
    return shade(scene, ray, *hit, hit->material, depth);
}

} // namespace rt
