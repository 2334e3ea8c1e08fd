// What a ray can hit, one vector per kind of shape: which of them it hits first, and whether any is in its
// way.
#pragma once

#include "01_spheres/plane.h"
#include "01_spheres/sphere.h"
#include "03_mirror/quad.h"
#include "common/util/match.h"

#include <algorithm>
#include <variant>
#include <vector>

namespace rt {

struct Shapes {
    std::vector<Sphere> spheres;
    std::vector<Plane> planes;
    std::vector<Quad> quads;
};

/// Returns the closest hit. Each hit shrinks t_max, so the last accepted hit is the closest. Full surface
/// data are computed for that one only.
inline std::optional<Hit> intersect(const Shapes& shapes, Ray ray) {
    std::variant<std::monostate, const Sphere*, const Plane*, const Quad*> closest;
    const auto test = [&](const auto& shape) {
        if (const auto t = intersect(shape, ray)) {
            ray.t_max = *t;
            closest = &shape;
        }
    };
    for (const Sphere& sphere : shapes.spheres) test(sphere);
    for (const Plane& plane : shapes.planes) test(plane);
    for (const Quad& quad : shapes.quads) test(quad);
    return match(
        closest, [](std::monostate) { return std::optional<Hit>(); },
        [&](const auto* shape) { return std::optional(surface_hit(*shape, ray)); });
}

/// Returns whether any shape is hit in the ray's interval; the first one found ends the search.
inline bool occluded(const Shapes& shapes, const Ray& ray) {
    const auto hit = [&](const auto& shape) { return intersect(shape, ray).has_value(); };
    return std::ranges::any_of(shapes.spheres, hit) || std::ranges::any_of(shapes.planes, hit) ||
           std::ranges::any_of(shapes.quads, hit);
}

} // namespace rt
