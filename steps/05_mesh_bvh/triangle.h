// Where a ray meets a triangle.
#pragma once

#include "01_spheres/ray.h"
#include "common/tally.h"

#include <optional>

namespace rt {

/// The point (1 - u - v) A + u B + v C = O + t D.
struct TriangleHit {
    float t, u, v;
};

/// Moller and Trumbore 1997: Cramer's rule on  t (-D) + u (B - A) + v (C - A) = O - A.  The determinant is
/// proportional to the area, so it is never compared with an absolute epsilon: that would lose small
/// triangles. Both sides count. A degenerate triangle divides by 0, and NaN or infinity fails every
/// comparison below.
inline std::optional<TriangleHit> intersect(vec3 a, vec3 b, vec3 c, const Ray& ray) {
    ++tally.triangle_tests;
    //> u, v and t from four cross and dot products, and out as soon as one of them is
    const vec3 edge_b = b - a;
    const vec3 edge_c = c - a;
    const vec3 p = cross(ray.direction, edge_c);
    const float inverse = 1 / dot(edge_b, p);
    const vec3 from_a = ray.origin - a;
    const float u = dot(from_a, p) * inverse;
    if (!(u >= 0 && u <= 1)) return std::nullopt;
    const vec3 q = cross(from_a, edge_b);
    const float v = dot(ray.direction, q) * inverse;
    if (!(v >= 0 && u + v <= 1)) return std::nullopt;
    const float t = dot(edge_c, q) * inverse;
    if (!contains(ray, t)) return std::nullopt;
    return TriangleHit{t, u, v};
    //< return std::nullopt;
}

} // namespace rt
