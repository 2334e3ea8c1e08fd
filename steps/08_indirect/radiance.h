// How light travels, in step 08: along one path after another, chosen by chance, until the average is the
// truth.
#pragma once

#include "02_shadows/light.h"
#include "04_refraction/glass.h"
#include "06_textures/texture.h"
#include "08_indirect/area_light.h"
#include "08_indirect/bounce.h"
#include "common/match.h"

#include <variant>

namespace rt {

/// Which light counts, and how it is looked for. The last two change the noise, never the mean.
struct Transport {
    int depth = 5;             ///< bounces of a path at most; the light beyond is left out
    bool indirect = true;      ///< false: matte surfaces see lights and sky, but not each other
    bool sample_lights = true; ///< false: area lights count only when a path happens to run into them
    bool roulette = true;      ///< false: every path runs its full length
};

/// Light that goes on as a single ray.
struct Specular {
    Ray ray;
    vec3 weight;
    vec3 absorption; ///< of the medium it goes on in
};

/// What the surface does with a path: it is matte, or it sends the path on. Where light has two ways, chance
/// picks one in proportion to its share, so that the weight is the same for both.
template <CastsShadows S>
std::variant<Diffuse, Specular> meet(const S& scene, const Ray& ray, const Hit& hit, int material,
                                     vec3 absorption, Random& random) {
    using Result = std::variant<Diffuse, Specular>;
    const auto mirrored = [&](vec3 tint) { return Specular{mirror_ray(ray, hit), tint, absorption}; };
    return match(
        scene.materials[std::size_t(material)], [&](const Diffuse& diffuse) -> Result { return diffuse; },
        [&](const Checker& checker) -> Result { return at(checker, hit.uv); },
        [&](const Textured& textured) -> Result { return at(textured, scene.textures, hit.uv); },
        [&](const Mirror& mirror) -> Result { return mirrored(mirror.tint); },
        [&](const Reflective& coat) -> Result {
            if (random.uniform() < coat.reflectivity) return mirrored(coat.tint);
            return meet(scene, ray, hit, coat.base, absorption, random);
        },
        [&](const Glass& glass) -> Result {
            const Boundary side = boundary(glass, ray, hit);
            const auto onward = refracted_ray(ray, hit, side);
            if (!onward || random.uniform() < side.reflectance) return mirrored(vec3(1));
            return Specular{*onward, vec3(1), side.beyond.absorption};
        });
}

/// An estimate of the radiance that comes back along the ray, W / (m^2 sr), linear RGB. Its mean over many
/// calls is the solution of the rendering equation (Kajiya 1986), cut after `depth` bounces. Caustics of area
/// lights are found by paths that run through glass into a lamp. Shortcut: a point light casts none, glass
/// throws its full shadow.
template <CastsShadows S>
vec3 radiance(const S& scene, const AreaLights& lights, const Transport& transport, Ray ray, Random& random) {
    vec3 gathered(0), throughput(1), absorption(0);
    bool asked = false; // the lights were asked at the last surface, so meeting one now would count it twice
    bool matte = false; // the path has met a matte surface
    for (int bounce = 0;; ++bounce) {
        const auto hit = intersect(scene, ray);
        if (!hit) {
            const bool clear = absorption == vec3(0); // a coloured medium without end lets nothing through
            return clear ? gathered + throughput * radiance(scene.sky, ray.direction) : gathered;
        }
        throughput *= transmittance(absorption, hit->t * length(ray.direction));
        const bool last = bounce == transport.depth || (matte && !transport.indirect);
        const auto met = meet(scene, ray, *hit, hit->material, absorption, random);
        if (const Specular* specular = std::get_if<Specular>(&met)) {
            if (last) return gathered;
            ray = specular->ray;
            absorption = specular->absorption;
            throughput *= specular->weight;
            asked = false;
        } else {
            const Diffuse& diffuse = std::get<Diffuse>(met);
            if (!asked) gathered += throughput * diffuse.emission;
            if (last) return gathered;
            vec3 arriving = direct_light(scene, *hit);
            if (transport.sample_lights) arriving += area_light(scene, lights, *hit, random, absorption);
            gathered += throughput * diffuse.albedo / pi * arriving;
            //> the bounce: cos / pi in the direction's density cancels cos / pi in the light it brings
            ray = ray_from(*hit, cosine_direction(hit->normal, random.uniform2()));
            throughput *= diffuse.albedo;
            //< return gathered;
            asked = transport.sample_lights;
            matte = true;
        }
        if (throughput == vec3(0)) return gathered;
        if (!transport.roulette || bounce < 2) continue;
        const auto survived = roulette(throughput, random);
        if (!survived) return gathered;
        throughput = *survived;
    }
}

} // namespace rt
