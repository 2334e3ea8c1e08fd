// A parallelogram: here a mirror on the wall, later a light in the ceiling.
#pragma once

#include "01_spheres/hit.h"

namespace rt {

/// The points corner + u edge_u + v edge_v with u, v in [0, 1]. It faces cross(edge_u, edge_v).
struct Quad {
    vec3 corner;
    vec3 edge_u;
    vec3 edge_v;
    int material;
};

/// Returns u and v of a point in the quad's plane. With n = U x V and p = P - corner = u U + v V:
///     u = (p x V).n / n.n,   v = (U x p).n / n.n.
inline vec2 quad_uv(const Quad& quad, dvec3 point) {
    const dvec3 u(quad.edge_u), v(quad.edge_v), p = point - dvec3(quad.corner);
    const dvec3 normal = cross(u, v);
    return vec2(glm::dvec2(dot(cross(p, v), normal), dot(cross(u, p), normal)) / dot(normal, normal));
}

/// Returns the t at which the ray hits the plane of the quad. In double, like the other shapes.
inline double plane_t(const Quad& quad, const Ray& ray) {
    const dvec3 normal = cross(dvec3(quad.edge_u), dvec3(quad.edge_v));
    return dot(dvec3(quad.corner) - dvec3(ray.origin), normal) / dot(dvec3(ray.direction), normal);
}

/// Returns the same t if the point is inside the four edges.
inline std::optional<float> intersect(const Quad& quad, const Ray& ray) {
    const double t = plane_t(quad, ray);
    if (!contains(ray, float(t))) return std::nullopt;
    const vec2 uv = quad_uv(quad, dvec3(ray.origin) + t * dvec3(ray.direction));
    if (uv.x < 0 || uv.x > 1 || uv.y < 0 || uv.y > 1) return std::nullopt;
    return float(t);
}

inline Hit surface_hit(const Quad& quad, const Ray& ray) {
    const vec3 outward_normal = normalize(cross(quad.edge_u, quad.edge_v));
    return make_hit(ray, outward_normal, quad_uv(quad, dvec3(at(ray, ray.t_max))), quad.material);
}

} // namespace rt
