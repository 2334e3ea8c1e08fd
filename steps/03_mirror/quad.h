// A parallelogram: a mirror on the wall, and later a lamp in the ceiling.
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

/// u and v of a point in the quad's plane. With n = U x V and p = P - corner = u U + v V:
///     u = (p x V).n / n.n,   v = (U x p).n / n.n.
inline vec2 quad_uv(const Quad& quad, vec3 point) {
    const vec3 normal = cross(quad.edge_u, quad.edge_v);
    const vec3 p = point - quad.corner;
    return vec2(dot(cross(p, quad.edge_v), normal), dot(cross(quad.edge_u, p), normal)) / dot(normal, normal);
}

/// The t at which the ray meets the plane of the quad, if it does so within the four edges.
inline std::optional<float> intersect(const Quad& quad, const Ray& ray) {
    const vec3 normal = cross(quad.edge_u, quad.edge_v);
    const float t = dot(quad.corner - ray.origin, normal) / dot(ray.direction, normal);
    if (!contains(ray, t)) return std::nullopt;
    const vec2 uv = quad_uv(quad, at(ray, t));
    if (uv.x < 0 || uv.x > 1 || uv.y < 0 || uv.y > 1) return std::nullopt;
    return t;
}

inline Hit surface(const Quad& quad, const Ray& ray) {
    const vec3 outward = normalize(cross(quad.edge_u, quad.edge_v));
    return make_hit(ray, outward, quad_uv(quad, at(ray, ray.t_max)), quad.material);
}

} // namespace rt
