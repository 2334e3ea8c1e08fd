// --view: what a ray hits, in place of the light it brings. The first thing to look at when a picture is
// wrong.
#pragma once

#include "01_spheres/hit.h"
#include "common/options.h"
#include "common/random.h"

namespace rt {

enum class View { light, normal, depth, uv, material, hits };

inline Choice<View> view_knob(Options& options) {
    return options.choice("view", {"light", "normal", "depth", "uv", "material", "hits"}, View::light,
                          "what to show: the light itself, or what the ray hits (its normal, how far it is, "
                          "where on the surface, which material, through how many surfaces the ray goes)");
}

/// How many surfaces the whole line of the ray crosses, at most `limit`.
template <Traceable S>
int surfaces_crossed(const S& scene, Ray ray, int limit) {
    int count = 0;
    while (count < limit) {
        const auto hit = intersect(scene, ray);
        if (!hit) break;
        ray.t_min = hit->t + hit->error / length(ray.direction);
        ++count;
    }
    return count;
}

/// A colour that tells number `index` from its neighbours.
inline vec3 colour_of(int index) {
    Random random{std::uint64_t(index)};
    return vec3(0.1f) + 0.8f * vec3(random.uniform(), random.uniform(), random.uniform());
}

/// `middle` is the distance that the depth view shows in mid grey.
template <Traceable S>
vec3 what_is_hit(const S& scene, const Ray& ray, View view, float middle) {
    if (view == View::hits) return vec3(float(surfaces_crossed(scene, ray, 8)) / 8);
    const auto hit = intersect(scene, ray);
    if (!hit) return vec3(0);
    const float distance = hit->t * length(ray.direction);
    switch (view) {
    case View::normal: return 0.5f + 0.5f * hit->normal;
    case View::depth: return vec3(distance / (distance + middle));
    case View::uv: return vec3(fract(hit->uv), 0);
    case View::material: return colour_of(hit->material);
    default: return vec3(0);
    }
}

} // namespace rt
