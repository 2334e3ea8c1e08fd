// What the world is made of: one vector per kind of shape, materials by number, and a sky around it all.
#pragma once

#include "01_spheres/background.h"
#include "01_spheres/diffuse.h"
#include "01_spheres/plane.h"
#include "01_spheres/sphere.h"
#include "02_shadows/light.h"
#include "common/util/match.h"
#include "common/util/tally.h"

#include <algorithm>
#include <variant>
#include <vector>

namespace rt {

using Material = std::variant<Diffuse, Checker>;

struct Scene {
    Sky sky;
    std::vector<Sphere> spheres;
    std::vector<Plane> planes;
    std::vector<PointLight> lights;
    std::vector<Material> materials;
};

/// Puts a material into the scene and answers its number.
inline int add(Scene& scene, const Material& material) {
    scene.materials.push_back(material);
    return int(scene.materials.size()) - 1;
}

/// What the ray meets first. Each hit shortens the ray, so the last one found is the nearest; only that one
/// is worked out in full.
inline std::optional<Hit> intersect(const Scene& scene, Ray ray) {
    ++tally.rays;
    std::variant<std::monostate, const Sphere*, const Plane*> nearest;
    //> try every shape; what hits becomes the nearest and shortens the ray
    const auto test = [&](const auto& shape) {
        if (const auto t = intersect(shape, ray)) {
            ray.t_max = *t;
            nearest = &shape;
        }
    };
    for (const Sphere& sphere : scene.spheres) test(sphere);
    for (const Plane& plane : scene.planes) test(plane);
    //<
    return match(
        nearest, [](std::monostate) { return std::optional<Hit>(); },
        [&](const auto* shape) { return std::optional(surface(*shape, ray)); });
}

/// Whether anything at all stands in the ray's interval: the first shape that does ends the search.
inline bool occluded(const Scene& scene, const Ray& ray) {
    ++tally.rays;
    //> true as soon as one shape is hit, whichever it is
    const auto hit = [&](const auto& shape) { return intersect(shape, ray).has_value(); };
    return std::ranges::any_of(scene.spheres, hit) || std::ranges::any_of(scene.planes, hit);
    //< return false;
}

} // namespace rt
