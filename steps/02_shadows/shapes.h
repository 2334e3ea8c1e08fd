// The any-hit query, which shadow rays need: is anything in the way?
#pragma once

#include "01_spheres/shapes.h"

#include <algorithm>

namespace rt {

/// Returns whether any shape is hit in the ray's interval; the first one found ends the search.
inline bool occluded(const Shapes& shapes, const Ray& ray) {
    //> is anything at all in the ray's way?
    const auto hit = [&](const auto& shape) { return intersect(shape, ray).has_value(); };
    return std::ranges::any_of(shapes.spheres, hit) || std::ranges::any_of(shapes.planes, hit);
    //< return false;
}

} // namespace rt
