// --view: false colours of what a ray hits, instead of radiance. Look here first if an image is wrong.
#pragma once

#include "01_spheres/hit.h"
#include "common/math/random.h"
#include "common/util/ray_stats.h"

#include <cmath>

namespace rt {

enum class DebugView { radiance, normal, depth, uv, material, depth_complexity, traversal_cost };

/// Returns how many surfaces the whole ray crosses, at most `limit`.
template <Traceable S>
int depth_complexity(const S& scene, Ray ray, int limit) {
    int count = 0;
    while (count < limit) {
        const auto hit = intersect(scene, ray);
        if (!hit) break;
        ray.t_min = hit->t + hit->position_error / length(ray.direction);
        ++count;
    }
    return count;
}

/// Returns a colour that distinguishes `index` from its neighbours.
inline vec3 id_colour(int index) {
    Random random{std::uint64_t(index)};
    return vec3(0.1f) + 0.8f * vec3(random.get_1d(), random.get_1d(), random.get_1d());
}

/// Maps [0, 1] to black, red, yellow, white.
inline vec3 heat_map(float value) {
    return clamp(3 * value - vec3(0, 1, 2), 0.0f, 1.0f);
}

/// Shows how many boxes and triangles are tested to find the closest hit, on a logarithmic scale: each
/// doubling moves the colour up by 1/16.
template <Traceable S>
vec3 cost_colour(const S& scene, const Ray& ray) {
    const auto tests = [] { return ray_stats.box_tests + ray_stats.triangle_tests; };
    const std::uint64_t before = tests();
    intersect(scene, ray);
    return heat_map(std::log2(1.0f + float(tests() - before)) / 16);
}

/// Returns the false colour of what the ray hits. The depth view shows `mid_grey_distance` as mid grey.
template <Traceable S>
vec3 debug_colour(const S& scene, const Ray& ray, DebugView view, float mid_grey_distance) {
    if (view == DebugView::depth_complexity) return vec3(float(depth_complexity(scene, ray, 8)) / 8);
    if (view == DebugView::traversal_cost) return cost_colour(scene, ray);
    const auto hit = intersect(scene, ray);
    if (!hit) return vec3(0);
    const float distance = hit->t * length(ray.direction);
    switch (view) {
    case DebugView::normal: return 0.5f + 0.5f * hit->shading_normal;
    case DebugView::depth: return vec3(distance / (distance + mid_grey_distance));
    case DebugView::uv: return vec3(fract(hit->uv), 0);
    case DebugView::material: return id_colour(hit->material);
    default: return vec3(0);
    }
}

} // namespace rt
