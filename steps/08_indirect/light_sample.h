// Uniform sampling of the area of a light: a quad, a triangle or a sphere.
#pragma once

#include "01_spheres/sphere.h"
#include "03_mirror/quad.h"
#include "08_indirect/hemisphere.h"
#include "common/model/vertex_normals.h"

#include <cmath>

namespace rt {

/// A point of a light, its normal, and the radiance it emits, W / (m^2 sr).
struct LightSample {
    vec3 position;
    vec3 normal;
    vec3 emission{0};
};

struct LightTriangle {
    vec3 a, b, c;
};

inline float area(const Quad& quad) {
    return length(cross(quad.edge_u, quad.edge_v));
}

inline float area(const LightTriangle& triangle) {
    return float(length(area_normal({triangle.a, triangle.b, triangle.c})) / 2);
}

inline float area(const Sphere& sphere) {
    return 4 * pi * sphere.radius * sphere.radius;
}

/// Samples a shape uniformly by area, from u in [0, 1)^2; in double and rounded once, so that a shadow ray
/// that ends `relative_epsilon` before the point does not hit the light itself.
inline LightSample sample_area(const Quad& quad, vec2 u) {
    const dvec3 across = double(u.x) * dvec3(quad.edge_u) + double(u.y) * dvec3(quad.edge_v);
    return {vec3(dvec3(quad.corner) + across), normalize(cross(quad.edge_u, quad.edge_v))};
}

/// A square folded along its diagonal would do; this warp keeps neighbours together (Osada et al. 2002, 4.2).
inline LightSample sample_area(const LightTriangle& triangle, vec2 u) {
    //> which weights of the three corners spread the points evenly over the triangle?
    const double root = std::sqrt(u.x), v = u.y;
    const dvec3 a(triangle.a), b(triangle.b), c(triangle.c);
    const vec3 position((1 - root) * a + root * (1 - v) * b + root * v * c);
    //< const vec3 position = triangle.a;
    return {position, vec3(normalize(area_normal({triangle.a, triangle.b, triangle.c})))};
}

/// Half of the points face away and contribute nothing.
inline LightSample sample_area(const Sphere& sphere, vec2 u) {
    const dvec3 normal = normalize(dvec3(sample_uniform_sphere(u)));
    return {vec3(dvec3(sphere.center) + double(sphere.radius) * normal), vec3(normal)};
}

} // namespace rt
