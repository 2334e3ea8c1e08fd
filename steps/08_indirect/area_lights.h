// Emissive surfaces, sampled directly (next-event estimation) instead of being hit by chance.
#pragma once

#include "02_shadows/point_light.h"
#include "03_mirror/quad.h"
#include "04_refraction/dielectric.h"
#include "05_mesh_bvh/mesh.h"
#include "06_textures/texture.h"
#include "08_indirect/hemisphere.h"
#include "08_indirect/light_sample.h"
#include "08_indirect/mis.h"
#include "common/image/image.h"
#include "common/math/random.h"
#include "common/util/match.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <variant>
#include <vector>

namespace rt {

struct AreaLight {
    std::variant<Quad, LightTriangle, Sphere> shape;
    vec3 emission; ///< radiance, W / (m^2 sr)
};

/// All area lights of a scene, to be sampled in proportion to their power.
struct AreaLights {
    std::vector<AreaLight> lights;
    std::vector<float> cdf; ///< cdf[i]: the share of lights 0 to i in the power of all
    float total_power = 0;  ///< of all: luminance(emission) times area, summed up
};

/// Returns the emitted radiance of a material.
template <typename S>
vec3 emission(const S& scene, int material) {
    return match(
        scene.materials[std::size_t(material)], [](const Diffuse& diffuse) { return diffuse.emission; },
        [](const ImageTexture& textured) { return textured.emission; },
        [&](const Coated& coat) { return (1 - coat.reflectivity) * emission(scene, coat.base); },
        [](const auto&) { return vec3(0); });
}

/// Collects the emissive quads, triangles and spheres. Infinite planes have no finite area and therefore
/// cannot be lights.
template <typename S>
AreaLights collect_area_lights(const S& scene) {
    AreaLights lights;
    double total_power = 0;
    std::vector<double> sums;
    const auto collect = [&](const auto& shape, int material) {
        const vec3 radiance = emission(scene, material);
        const double power = double(luminance(radiance)) * double(area(shape));
        if (!(power > 0)) return;
        lights.lights.push_back({shape, radiance});
        sums.push_back(total_power += power);
    };
    for (const Quad& quad : scene.quads) collect(quad, quad.material);
    for (const Sphere& sphere : scene.spheres) collect(sphere, sphere.material);
    for (std::uint32_t i = 0; i < scene.mesh.triangles.size(); ++i) {
        const auto [a, b, c] = vertices(scene.mesh, i);
        collect(LightTriangle{a, b, c}, scene.mesh.materials[i]);
    }
    for (const double sum : sums) lights.cdf.push_back(float(sum / total_power));
    lights.total_power = float(total_power);
    return lights;
}

/// Samples a point of one of the lights, u in [0, 1)^2. Chosen by power and then uniformly, it has the
/// density luminance(emission) / total_power over the area of all lights.
inline LightSample sample_light(const AreaLights& lights, vec2 u) {
    const auto upper = std::ranges::upper_bound(lights.cdf, u.x);
    const auto index = std::min(std::size_t(upper - lights.cdf.begin()), lights.lights.size() - 1);
    const float cdf_below = index > 0 ? lights.cdf[index - 1] : 0;
    u.x = (u.x - cdf_below) / (lights.cdf[index] - cdf_below); // the remainder of the choice is uniform again
    u.x = glm::clamp(u.x, 0.0f, 0x1.fffffep-1f);
    const AreaLight& light = lights.lights[index];
    LightSample sample = match(light.shape, [&](const auto& shape) { return sample_area(shape, u); });
    sample.emission = light.emission;
    return sample;
}

/// Returns the pdf, 1/sr, of the direction to such a point at `distance`, with this cosine to the light's
/// normal. The area dA subtends the solid angle dA cos / distance^2, so
///     p(w) = p(A) distance^2 / cos,   p(A) = luminance(emission) / total_power.
inline float light_pdf(const AreaLights& lights, vec3 emission, float distance, float cosine) {
    if (lights.lights.empty()) return 0;
    const float pdf = luminance(emission) / lights.total_power * distance * distance / std::abs(cosine);
    return glm::min(pdf, std::numeric_limits<float>::max()); // seen edge-on
}

/// Estimates the irradiance at the hit from all area lights, W/m^2, by one point of one light:
///     E ~ L cos(theta) V / p,   p = the pdf of the point's direction.
/// Lights emit to both sides; V is 1 if the two points are mutually visible, else 0. `absorption` is that of
/// the medium between them. `bsdf_sampling`: if set, weight by MIS against this BSDF sampling strategy.
template <Occludable S, RandomSource Source>
vec3 sample_area_lights(const S& scene, const AreaLights& lights, const Hit& hit, Source& source,
                        vec3 absorption = vec3(0),
                        std::optional<HemisphereSampling> bsdf_sampling = std::nullopt) {
    if (lights.lights.empty()) return vec3(0);
    const LightSample sample = sample_light(lights, source.get_2d());
    //> what does one sampled point of a lamp contribute to the irradiance at the hit, on average?
    const vec3 to_light = sample.position - hit.position;
    const float distance = length(to_light);
    const float cosine = dot(to_light, hit.shading_normal) / distance;
    const float light_cosine = dot(to_light, sample.normal) / distance;
    if (!(cosine > 0) || light_cosine == 0) return vec3(0);
    const float pdf = light_pdf(lights, sample.emission, distance, light_cosine);
    const float weight = bsdf_sampling ? power_heuristic(pdf, hemisphere_pdf(*bsdf_sampling, cosine)) : 1;
    const float sign = light_cosine < 0 ? 1.0f : -1.0f; // stop just before the light itself
    const vec3 shadow_offset = sign * position_error(hit.position, sample.position) * sample.normal;
    if (occluded(scene, spawn_ray_to(hit, sample.position + shadow_offset))) return vec3(0);
    const vec3 irradiance = sample.emission * (cosine * weight / pdf);
    return absorption == vec3(0) ? irradiance : irradiance * transmittance(absorption, distance);
    //< return vec3(0);
}

} // namespace rt
