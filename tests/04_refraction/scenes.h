// Scenes of glass for the checks of step 04: a ball, a slab, a white furnace, and rays that go through them.
#pragma once

#include "04_refraction/scene.h"
#include "tests/04_refraction/step.h"

#include <stdexcept>

namespace rt {

/// A scene that loses its patience: a ray that meets again and again the surface that it leaves would double
/// the work with each boundary, and a check should fail rather than hang.
struct Glassware : Scene {
    mutable int questions = 0;
};

inline std::optional<Hit> intersect(const Glassware& scene, const Ray& ray) {
    if (++scene.questions > 1000000)
        throw std::runtime_error("a million rays: do they start where they meet the same surface again?");
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

/// One ball of radius 2 off the origin, in a world that shines white from everywhere.
inline Glassware ball_of(const Dielectric& glass) {
    Glassware scene = white_furnace();
    scene.spheres = {{center, radius, add(scene.materials, glass)}};
    return scene;
}

/// A ray with |d| = 2 that flies along -normal past the centre, `offset` radii beside it. It starts 5 away.
inline Ray ray_beside(float offset) {
    return {center + 5.0f * normal + offset * radius * tangent, -2.0f * normal};
}

/// The ray that goes on through the first boundary that `ray` meets, if any does.
inline std::optional<Ray> passed(const Glassware& scene, const Ray& ray) {
    const auto hit = intersect(scene, ray);
    if (!hit) return std::nullopt;
    const Dielectric& glass = std::get<Dielectric>(scene.materials[std::size_t(hit->material)]);
    return refracted_ray(ray, *hit, make_interface(glass, ray, *hit));
}

/// A slab of glass between two planes at right angles to `normal`, its upper side through the origin.
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
