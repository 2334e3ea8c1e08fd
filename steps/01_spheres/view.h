// --view: what a ray hits, in place of the light it brings. The first thing to look at when a picture is
// wrong.
#pragma once

#include "01_spheres/hit.h"
#include "common/cli/options.h"
#include "common/math/random.h"
#include "common/util/tally.h"

#include <cmath>

namespace rt {

enum class View { light, normal, depth, uv, material, hits, work };

inline Choice<View> view_knob(Options& options) {
    return options.choice(
        "view", {"light", "normal", "depth", "uv", "material", "hits", "work"}, View::light,
        "what to show: the light itself, or what the ray hits (its normal, how far it is, "
        "where on the surface, which material, through how many surfaces the ray goes, and, "
        "from step 05 on, how much work it is to find the nearest)");
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

/// From black over red and yellow to white, for 0 to 1.
inline vec3 heat(float share) {
    return clamp(3 * share - vec3(0, 1, 2), 0.0f, 1.0f);
}

/// How many boxes and triangles it takes to find the nearest hit, each doubling a sixteenth further up in heat.
template <Traceable S>
vec3 work(const S& scene, const Ray& ray) {
    const auto tests = [] { return tally.box_tests + tally.triangle_tests; };
    const std::uint64_t before = tests();
    intersect(scene, ray);
    return heat(std::log2(1.0f + float(tests() - before)) / 16);
}

/// `middle` is the distance that the depth view shows in mid grey.
template <Traceable S>
vec3 what_is_hit(const S& scene, const Ray& ray, View view, float middle) {
    if (view == View::hits) return vec3(float(surfaces_crossed(scene, ray, 8)) / 8);
    if (view == View::work) return work(scene, ray);
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
