// Where a ray hits a triangle (Moller and Trumbore).
#pragma once

#include "01_spheres/ray.h"

#include <optional>

namespace rt {

/// The point (1 - u - v) A + u B + v C = O + t D.
struct TriangleHit {
    float t, u, v;
};

/// How far, in barycentric weight, a triangle extends over its edge: a few roundings of a double. In float,
/// and without it, rays slip through the edge that two triangles share.
inline constexpr double edge_tolerance = 0x1p-40;

/// Moller and Trumbore 1997: Cramer's rule on  t (-D) + u (B - A) + v (C - A) = O - A.  The determinant is
/// proportional to the area, so it is never compared with an absolute epsilon: that would lose small
/// triangles. Both sides count. A degenerate triangle divides by 0, and NaN or infinity fails every
/// comparison below.
inline std::optional<TriangleHit> intersect(vec3 a, vec3 b, vec3 c, const Ray& ray) {
    //> where does the ray meet the plane of the triangle, and is that inside all three edges?
    const glm::dvec3 vertex_a(a), direction(ray.direction);
    const glm::dvec3 edge_b = glm::dvec3(b) - vertex_a;
    const glm::dvec3 edge_c = glm::dvec3(c) - vertex_a;
    const glm::dvec3 p_vec = cross(direction, edge_c);
    const double inverse_determinant = 1 / dot(edge_b, p_vec);
    const glm::dvec3 t_vec = glm::dvec3(ray.origin) - vertex_a;
    const double u = dot(t_vec, p_vec) * inverse_determinant;
    if (!(u >= -edge_tolerance && u <= 1 + edge_tolerance)) return std::nullopt;
    const glm::dvec3 q_vec = cross(t_vec, edge_b);
    const double v = dot(direction, q_vec) * inverse_determinant;
    if (!(v >= -edge_tolerance && u + v <= 1 + edge_tolerance)) return std::nullopt;
    const float t = float(dot(edge_c, q_vec) * inverse_determinant);
    if (!contains(ray, t)) return std::nullopt;
    return TriangleHit{t, float(u), float(v)};
    //< return std::nullopt;
}

} // namespace rt
