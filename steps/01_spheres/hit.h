// What a ray hits: plain data, computed once, for the closest surface.
#pragma once

#include "01_spheres/ray.h"

#include <concepts>
#include <optional>

namespace rt {

/// Relative offset of secondary rays: this fraction of the largest coordinate M of the ray's origin and of
/// the hit. No other number moves a ray. Shapes are tested in double, so what is left are three roundings to
/// float, each of a relative 2^-24: of t, along a way of at most 2 M per axis; of the hit's position; and of
/// the moved origin of the next ray. A unit normal has |x| + |y| + |z| <= sqrt(3), so a point is off its
/// surface by at most (2 + 1 + 1) sqrt(3) 2^-24 M < 2^-21 M.
inline constexpr float relative_epsilon = 0x1p-21f;

/// Bounds how far a hit along a ray from `origin` may be off its surface, in metres.
inline float position_error(vec3 origin, vec3 position) {
    const vec3 reach = max(abs(position), abs(origin));
    return relative_epsilon * glm::max(reach.x, glm::max(reach.y, reach.z));
}

struct Hit {
    float t; ///< along the ray
    vec3 position;
    vec3 shading_normal;   ///< unit, on the side that the ray comes from; interpolated where a mesh is smooth
    vec3 geometric_normal; ///< unit, of the true surface, on the same side
    vec2 uv;               ///< where on the surface
    int material;          ///< index into the scene's materials
    bool back_face;        ///< the ray came from within the shape
    float position_error;  ///< how far `position` may be off the true surface
    vec3 vertex_color{1};  ///< multiplies the albedo: of a mesh with coloured vertices (step 05), or white
};

/// Returns the hit at the end of `ray`, at t_max. `outward_normal` is the shape's own unit normal,
/// `shading_normal` the one to shade with. Both are flipped here, once, toward the side that the ray comes
/// from, so that no other code has to.
inline Hit make_hit(const Ray& ray, vec3 outward_normal, vec3 shading_normal, vec2 uv, int material) {
    const vec3 position = at(ray, ray.t_max);
    const float error = position_error(ray.origin, position);
    //> does the ray meet the surface from inside, and what must the normals do then?
    const bool back_face = dot(ray.direction, outward_normal) > 0;
    const float sign = back_face ? -1.0f : 1.0f;
    //< const bool back_face = false; const float sign = 1;
    return {ray.t_max, position, sign * shading_normal, sign * outward_normal, uv, material,
            back_face, error};
}

inline Hit make_hit(const Ray& ray, vec3 outward_normal, vec2 uv, int material) {
    return make_hit(ray, outward_normal, outward_normal, uv, material);
}

/// A scene that answers the closest-hit query. Light transport needs no more than this, so the code of one
/// chapter also works on the scenes of later chapters.
template <typename Scene>
concept Traceable = requires(const Scene& scene, const Ray& ray) {
    { intersect(scene, ray) } -> std::same_as<std::optional<Hit>>;
};

} // namespace rt
