// Where a ray hits a primitive, computed in double and rounded once.
#pragma once

#include "accel/ray.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace rt::accel {

/// Returns the hit of a ray that passes through the outline of the triangle, if it lies in the ray's interval
/// (Moller and Trumbore 1997). It does not test the outline again: a second test with other rounding would
/// open the edges. Where rounding put the point outside, u and v are clamped to the triangle, and t to the
/// range of its vertices, also for a triangle that is seen edge-on.
inline std::optional<ExactHit> exact_hit(const std::array<vec3, 3>& vertices, const RayLike auto& ray) {
    const dvec3 a(vertices[0]), direction(ray.direction);
    const dvec3 edge_b = dvec3(vertices[1]) - a, edge_c = dvec3(vertices[2]) - a;
    const dvec3 p = cross(direction, edge_c), t_vec = dvec3(ray.origin) - a, q = cross(t_vec, edge_b);
    const double determinant = dot(edge_b, p), numerator = dot(edge_c, q);
    if (numerator * determinant <= 0)
        return std::nullopt; // behind the origin, or the triangle that the ray starts on
    const double inverse_determinant = 1 / determinant;
    double t = numerator * inverse_determinant;
    if (!in_interval(ray, float(t))) return std::nullopt;
    double u = dot(t_vec, p) * inverse_determinant, v = dot(direction, q) * inverse_determinant;
    if (!(u >= 0 && v >= 0 && u + v <= 1)) [[unlikely]] {
        u = std::clamp(u, 0.0, 1.0);
        v = std::clamp(v, 0.0, 1 - u);
        const dvec3 along = direction / dot(direction, direction);
        const dvec3 vertex_t(-dot(t_vec, along), dot(edge_b - t_vec, along), dot(edge_c - t_vec, along));
        t = std::clamp(t, std::min({vertex_t.x, vertex_t.y, vertex_t.z}),
                       std::max({vertex_t.x, vertex_t.y, vertex_t.z}));
        if (!in_interval(ray, float(t))) return std::nullopt;
    }
    return ExactHit{float(t), float(u), float(v)};
}

/// Returns the smallest t in the ray's interval with |O + tD - C|^2 = r^2, which is a t^2 - 2 h t + c = 0.
/// The roots are q/a and c/q: neither subtracts two nearly equal numbers (Press et al.,
/// Numerical Recipes, section 5.6).
inline std::optional<ExactHit> exact_hit(const Sphere& sphere, const RayLike auto& ray) {
    const dvec3 to_center = dvec3(sphere.center) - dvec3(ray.origin), direction(ray.direction);
    const double radius = sphere.radius;
    const double a = dot(direction, direction), h = dot(direction, to_center);
    const double c = dot(to_center, to_center) - radius * radius, discriminant = h * h - a * c;
    if (discriminant < 0) return std::nullopt;
    const double q = h + std::copysign(std::sqrt(discriminant), h);
    float near = float(q / a), far = float(c / q);
    if (far < near) std::swap(near, far);
    if (in_interval(ray, near)) return ExactHit{near};
    if (in_interval(ray, far)) return ExactHit{far};
    return std::nullopt;
}

} // namespace rt::accel
