// What a ray can hit, one vector per kind of shape, and which of them it hits first.
#pragma once

#include "01_spheres/plane.h"
#include "01_spheres/sphere.h"
#include "common/util/match.h"

#include <variant>
#include <vector>

namespace rt {

struct Shapes {
    std::vector<Sphere> spheres;
    std::vector<Plane> planes;
};

/// Returns the closest hit. Each hit shrinks t_max, so the last accepted hit is the closest. Full surface
/// data are computed for that one only.
inline std::optional<Hit> intersect(const Shapes& shapes, Ray ray) {
    std::variant<std::monostate, const Sphere*, const Plane*> closest;
    //> which of all shapes does the ray hit first? That one is `closest`, and the ray ends there
    const auto test = [&](const auto& shape) {
        if (const auto t = intersect(shape, ray)) {
            ray.t_max = *t;
            closest = &shape;
        }
    };
    for (const Sphere& sphere : shapes.spheres) test(sphere);
    for (const Plane& plane : shapes.planes) test(plane);
    //<
    return match(
        closest, [](std::monostate) { return std::optional<Hit>(); },
        [&](const auto* shape) { return std::optional(surface_hit(*shape, ray)); });
}

} // namespace rt
