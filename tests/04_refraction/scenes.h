// Scenes of glass for the checks of step 04: a ball, a slab, a white furnace, and rays through them.
#pragma once

#include "04_refraction/scene.h"
#include "tests/04_refraction/step.h"

#include <stdexcept>

namespace rt {

/// A scene that limits its number of queries: a ray that repeatedly hits the surface that it leaves would
/// double the work at each boundary, and a check should fail instead of hanging.
struct Glassware : Scene {
    mutable int questions = 0;
};

inline std::optional<Hit> intersect(const Glassware& scene, const Ray& ray) {
    if (++scene.questions > 1000000)
        throw std::runtime_error("a million rays: do they start where they hit the same surface again?");
    return intersect(static_cast<const Scene&>(scene), ray);
}

inline bool occluded(const Glassware& scene, const Ray& ray) {
    return occluded(static_cast<const Scene&>(scene), ray);
}

inline Glassware white_furnace() {
    Glassware scene;
    scene.sky = {vec3(1), vec3(1)};
    return scene;
}

inline const vec3 center = {1, -2, 3};
inline constexpr float radius = 2;

/// Builds one ball of radius 2 away from the origin, in a uniformly white world.
inline Glassware ball_of(const Dielectric& glass) {
    Glassware scene = white_furnace();
    scene.spheres = {{center, radius, add(scene.materials, glass)}};
    return scene;
}

/// Returns a ray with |d| = 2 along -normal that passes the centre at `offset` radii.
/// It starts 5 units before it.
inline Ray ray_beside(float offset) {
    return {center + 5.0f * normal + offset * radius * tangent, -2.0f * normal};
}

/// Returns the refracted ray at the first boundary that `ray` hits, if there is one.
inline std::optional<Ray> passed(const Glassware& scene, const Ray& ray) {
    const auto hit = intersect(scene, ray);
    if (!hit) return std::nullopt;
    const Dielectric& glass = std::get<Dielectric>(scene.materials[std::size_t(hit->material)]);
    return refracted_ray(ray, *hit, make_interface(glass, ray, *hit));
}

/// Builds a slab of glass between two planes perpendicular to `normal`, its upper side through the origin.
inline Glassware slab_of(const Medium& medium, float thickness) {
    Glassware scene;
    const int glass = add(scene.materials, Dielectric{medium});
    scene.planes = {{vec3(0), normal, glass}, {-thickness * normal, -normal, glass}};
    return scene;
}

inline const Medium air{};
inline const Medium glass_15{1.5f};
inline const Dielectric ball{glass_15};
inline const Dielectric bubble{air, glass_15};

} // namespace rt
