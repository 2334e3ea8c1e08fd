// How light travels, in step 08: along one path after another, chosen by chance, until the average is the
// truth.
#pragma once

#include "02_shadows/point_light.h"
#include "04_refraction/dielectric.h"
#include "06_textures/texture.h"
#include "08_indirect/area_light.h"
#include "08_indirect/bounce.h"
#include "08_indirect/metal.h"
#include "common/util/match.h"

#include <variant>

namespace rt {

/// How paths look for area lights: by asking them at every matte surface, by running into them, or by both
/// with multiple importance sampling.
enum class Direct { mis, lights, bounces };

/// Which light counts, and how it is looked for. The last three change the noise, never the mean.
struct Transport {
    int depth = 5;        ///< bounces of a path at most; the light beyond is left out
    bool indirect = true; ///< false: matte surfaces see lights and sky, but not each other
    Direct direct = Direct::mis;
    bool roulette = true;           ///< false: every path runs its full length
    Spread spread = Spread::cosine; ///< of bounces
};

/// Light that goes on as a single ray.
struct Specular {
    Ray ray;
    vec3 weight;
    vec3 absorption; ///< of the medium it goes on in
};

/// What the surface does with a path: it is matte, or it sends the path on. Where light has two ways, chance
/// picks one in proportion to its share, so that the weight is the same for both.
template <Occludable S, UniformSource Source>
std::variant<Diffuse, Specular> meet(const S& scene, const Ray& ray, const Hit& hit, vec3 absorption,
                                     Source& source) {
    using Result = std::variant<Diffuse, Specular>;
    const auto mirrored = [&](vec3 reflectance) {
        return Specular{reflected_ray(ray, hit), reflectance, absorption};
    };
    int material = hit.material;
    while (const auto* coat = std::get_if<Coated>(&scene.materials[std::size_t(material)])) {
        if (source.uniform() < coat->reflectivity) return mirrored(coat->reflectance);
        material = coat->base;
    }
    return match(
        scene.materials[std::size_t(material)],
        [&](const auto& matte) -> Result { return matte_at(matte, scene, hit); },
        [&](const Mirror& mirror) -> Result { return mirrored(mirror.reflectance); },
        [&](const Metal& metal) -> Result {
            const auto onward = metal_ray(metal, ray, hit, source.uniform2());
            if (!onward) return Diffuse{vec3(0)}; // it ends here
            return Specular{*onward, metal.albedo, absorption};
        },
        [&](const Coated&) -> Result { return Diffuse{vec3(0)}; }, // taken off above
        [&](const Dielectric& dielectric) -> Result {
            const Interface interface = make_interface(dielectric, ray, hit);
            const auto onward = refracted_ray(ray, hit, interface);
            if (!onward || source.uniform() < interface.reflectance) return mirrored(vec3(1));
            return Specular{*onward, vec3(1), interface.transmitted_medium.absorption_coefficient};
        });
}

/// An estimate of the irradiance at the hit from all lights, as far as they are to be asked for it, W/m^2.
template <Occludable S, UniformSource Source>
vec3 asked(const S& scene, const AreaLights& lights, const Transport& transport, const Hit& hit,
           vec3 absorption, Source& source) {
    const vec3 from_points = direct_irradiance(scene, hit);
    if (transport.direct == Direct::bounces) return from_points;
    const Spread* rivals = transport.direct == Direct::mis ? &transport.spread : nullptr;
    return from_points + area_light(scene, lights, hit, source, absorption, rivals);
}

/// The share of a lamp's light that counts where a path runs into it. `density` is that of the ray's
/// direction, which has unit length then; infinite if the path had no other way.
template <typename S>
float found(const S& scene, const AreaLights& lights, const Transport& transport, const Ray& ray,
            const Hit& hit, float density) {
    if (density == infinity || transport.direct == Direct::bounces) return 1;
    if (transport.direct == Direct::lights) return 0;
    const float cosine = dot(ray.direction, hit.geometric_normal);
    return share(density, light_pdf(lights, emission(scene, hit.material), hit.t, cosine));
}

/// An estimate of the radiance that comes back along the ray, W / (m^2 sr), linear RGB. Its mean over many
/// calls is the solution of the rendering equation (Kajiya 1986), cut after `depth` bounces. Caustics of area
/// lights are found by paths that run through glass or by mirrors into a lamp. Shortcut: a point light casts
/// none, glass throws its full shadow.
template <Occludable S, UniformSource Source>
vec3 radiance(const S& scene, const AreaLights& lights, const Transport& transport, Ray ray, Source& source) {
    vec3 gathered(0), throughput(1), absorption(0);
    float density = infinity; // of the ray's direction; infinite from a mirror or the eye: no lamp was asked
    bool matte = false;       // the path has met a matte surface
    for (int bounce = 0;; ++bounce) {
        const auto hit = intersect(scene, ray);
        if (!hit && absorption != vec3(0))
            return gathered; // a coloured medium without end lets nothing through
        if (!hit) return gathered + throughput * radiance(scene.sky, ray.direction);
        if (absorption != vec3(0)) throughput *= transmittance(absorption, hit->t * length(ray.direction));
        const bool last = bounce == transport.depth || (matte && !transport.indirect);
        const auto met = meet(scene, ray, *hit, absorption, source);
        if (const Specular* specular = std::get_if<Specular>(&met)) {
            if (last) return gathered;
            ray = specular->ray;
            absorption = specular->absorption;
            throughput *= specular->weight;
            density = infinity;
        } else {
            const Diffuse& diffuse = std::get<Diffuse>(met);
            if (diffuse.emission != vec3(0))
                gathered +=
                    throughput * diffuse.emission * found(scene, lights, transport, ray, *hit, density);
            if (last || diffuse.albedo == vec3(0)) return gathered;
            throughput *= diffuse.albedo * hit->tint;
            gathered += throughput * asked(scene, lights, transport, *hit, absorption, source) / pi;
            //> the cosine over pi times the density, which is 1 where bounces go by the cosine
            const vec3 direction = bounce_direction(transport.spread, hit->shading_normal, source.uniform2());
            const float cosine = dot(direction, hit->shading_normal);
            density = bounce_pdf(transport.spread, cosine);
            throughput *= cosine / (pi * density);
            ray = {offset_ray_origin(*hit, hit->geometric_normal), direction};
            //< return gathered;
            matte = true;
        }
        if (throughput == vec3(0)) return gathered;
        if (!transport.roulette || bounce < 2) continue;
        const auto survived = roulette(throughput, source);
        if (!survived) return gathered;
        throughput = *survived;
    }
}

} // namespace rt
