// How light travels, in step 02: from visible lights to the first surface, and from there to the eye.
#pragma once

#include "02_shadows/point_light.h"
#include "common/util/match.h"

namespace rt {

/// Returns the radiance arriving along the ray, W / (m^2 sr), linear RGB.
template <Occludable S>
vec3 radiance(const S& scene, const Ray& ray) {
    const auto hit = intersect(scene, ray);
    if (!hit) return radiance(scene.sky, ray.direction);
    return match(scene.materials[std::size_t(hit->material)],
                 [&](const auto& matte) { return shade_diffuse(scene, *hit, matte_at(matte, scene, *hit)); });
}

} // namespace rt
