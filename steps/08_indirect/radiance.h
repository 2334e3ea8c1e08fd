// Path tracing: averages random light paths, which converges to the exact solution.
#pragma once

#include "02_shadows/point_light.h"
#include "04_refraction/dielectric.h"
#include "06_textures/texture.h"
#include "08_indirect/area_lights.h"
#include "08_indirect/hemisphere.h"
#include "08_indirect/metal.h"
#include "08_indirect/roulette.h"
#include "common/util/match.h"

#include <optional>
#include <variant>

namespace rt {

/// How paths find area lights: by sampling them at every diffuse surface, by hitting them with bounces, or by
/// both with multiple importance sampling.
enum class DirectLighting { mis, light_sampling, bsdf_sampling };

/// Which light counts, and how it is sampled. The last three change the noise, never the mean.
struct PathSettings {
    int depth = 5;        ///< maximum bounces of a path; light beyond is left out
    bool indirect = true; ///< false: diffuse surfaces see lights and sky, but not each other
    DirectLighting direct = DirectLighting::mis;
    bool roulette = true; ///< false: every path runs its full length
    HemisphereSampling hemisphere_sampling = HemisphereSampling::cosine; ///< of bounces
};

/// A path that continues as a single ray.
struct ScatteredRay {
    Ray ray;
    vec3 weight;
    vec3 absorption; ///< of the medium it continues in
};

/// Returns what the surface does with a path: it is diffuse, or it scatters the path as one ray. At glass and
/// coatings one of the two branches is chosen with its own reflectance as the probability, so probability and
/// weight cancel.
template <Occludable S, RandomSource Source>
std::variant<Diffuse, ScatteredRay> scatter(const S& scene, const Ray& ray, const Hit& hit, vec3 absorption,
                                            Source& source) {
    using Result = std::variant<Diffuse, ScatteredRay>;
    const auto reflected = [&](vec3 reflectance) {
        return ScatteredRay{reflected_ray(ray, hit), reflectance, absorption};
    };
    int material = hit.material;
    while (const auto* coat = std::get_if<Coated>(&scene.materials[std::size_t(material)])) {
        if (source.get_1d() < coat->reflectivity) return reflected(coat->reflectance);
        material = coat->base;
    }
    return match(
        scene.materials[std::size_t(material)],
        [&](const auto& matte) -> Result { return matte_at(matte, scene, hit); },
        [&](const Mirror& mirror) -> Result { return reflected(mirror.reflectance); },
        [&](const Metal& metal) -> Result {
            const auto scattered = scatter_metal(metal, ray, hit, source.get_2d());
            if (!scattered) return Diffuse{vec3(0)}; // it ends here
            return ScatteredRay{*scattered, metal.reflectance, absorption};
        },
        [&](const Coated&) -> Result { return Diffuse{vec3(0)}; }, // taken off above
        [&](const Dielectric& dielectric) -> Result {
            const Interface interface = make_interface(dielectric, ray, hit);
            const auto refracted = refracted_ray(ray, hit, interface);
            if (!refracted || source.get_1d() < interface.reflectance) return reflected(vec3(1));
            return ScatteredRay{*refracted, vec3(1), interface.transmitted_medium.absorption_coefficient};
        });
}

/// Estimates the irradiance at the hit from the lights that `settings.direct` says to sample, W/m^2.
template <Occludable S, RandomSource Source>
vec3 sample_direct_light(const S& scene, const AreaLights& lights, const PathSettings& settings,
                         const Hit& hit, vec3 absorption, Source& source) {
    const vec3 from_points = direct_irradiance(scene, hit);
    if (settings.direct == DirectLighting::bsdf_sampling) return from_points;
    std::optional<HemisphereSampling> bsdf_sampling;
    if (settings.direct == DirectLighting::mis) bsdf_sampling = settings.hemisphere_sampling;
    return from_points + sample_area_lights(scene, lights, hit, source, absorption, bsdf_sampling);
}

/// Returns the MIS weight of emission hit by a ray. `pdf` is the density of its direction, which has unit
/// length then; none for a specular bounce or a camera ray, for which light sampling was impossible (weight
/// 1).
template <typename S>
float emission_weight(const S& scene, const AreaLights& lights, const PathSettings& settings, const Ray& ray,
                      const Hit& hit, std::optional<float> pdf) {
    if (!pdf || settings.direct == DirectLighting::bsdf_sampling) return 1;
    if (settings.direct == DirectLighting::light_sampling) return 0;
    const float cosine = dot(ray.direction, hit.geometric_normal);
    return power_heuristic(*pdf, light_pdf(lights, emission(scene, hit.material), hit.t, cosine));
}

/// Estimates the radiance arriving along the ray, W / (m^2 sr), linear RGB. Its expected value is the
/// solution of the rendering equation (Kajiya 1986), truncated after `depth` bounces. Caustics of area lights
/// come from paths that reach a light through glass or by mirrors. Shortcut: point lights cast none, and
/// glass casts a full shadow.
template <Occludable S, RandomSource Source>
vec3 radiance(const S& scene, const AreaLights& lights, const PathSettings& settings, Ray ray,
              Source& source) {
    vec3 path_radiance(0), throughput(1), absorption(0);
    std::optional<float> pdf; // of the ray's direction; none after a specular bounce or from the eye
    bool hit_diffuse = false; // the path has hit a diffuse surface
    for (int bounce = 0;; ++bounce) {
        const auto hit = intersect(scene, ray);
        if (!hit && absorption != vec3(0))
            return path_radiance; // an unbounded absorbing medium transmits nothing
        if (!hit) return path_radiance + throughput * radiance(scene.sky, ray.direction);
        if (absorption != vec3(0)) throughput *= transmittance(absorption, hit->t * length(ray.direction));
        const bool last = bounce == settings.depth || (hit_diffuse && !settings.indirect);
        const auto interaction = scatter(scene, ray, *hit, absorption, source);
        if (const ScatteredRay* scattered = std::get_if<ScatteredRay>(&interaction)) {
            if (last) return path_radiance;
            ray = scattered->ray;
            absorption = scattered->absorption;
            throughput *= scattered->weight;
            pdf = std::nullopt;
        } else {
            const Diffuse& diffuse = std::get<Diffuse>(interaction);
            if (diffuse.emission != vec3(0))
                path_radiance +=
                    throughput * diffuse.emission * emission_weight(scene, lights, settings, ray, *hit, pdf);
            if (last || diffuse.albedo == vec3(0)) return path_radiance;
            throughput *= diffuse.albedo * hit->vertex_color;
            path_radiance +=
                throughput * sample_direct_light(scene, lights, settings, *hit, absorption, source) / pi;
            //> where does the path go on, how likely was that, and what does the throughput become?
            const vec3 direction =
                sample_hemisphere(settings.hemisphere_sampling, hit->shading_normal, source.get_2d());
            const float cosine = dot(direction, hit->shading_normal);
            pdf = hemisphere_pdf(settings.hemisphere_sampling, cosine);
            throughput *= cosine / (pi * *pdf);
            ray = {offset_ray_origin(*hit, hit->geometric_normal), direction};
            //< return path_radiance;
            hit_diffuse = true;
        }
        if (throughput == vec3(0)) return path_radiance;
        if (!settings.roulette || bounce < 2) continue;
        const auto continued = russian_roulette(throughput, source);
        if (!continued) return path_radiance;
        throughput = *continued;
    }
}

} // namespace rt
