// Whether anything stands in the way of a ray: the question of shadow rays.
#pragma once

#include "01_spheres/shapes.h"

#include <algorithm>

namespace rt {

/// Whether anything at all stands in the ray's interval: the first shape that does ends the search.
inline bool occluded(const Shapes& shapes, const Ray& ray) {
    ++ray_stats.rays;
    //> true as soon as one shape is hit, whichever it is
    const auto hit = [&](const auto& shape) { return intersect(shape, ray).has_value(); };
    return std::ranges::any_of(shapes.spheres, hit) || std::ranges::any_of(shapes.planes, hit);
    //< return false;
}

} // namespace rt
