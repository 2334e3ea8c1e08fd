// What the checks of lamps share: the irradiance from lamps, by sampling and by Lambert's formula.
#pragma once

#include "08_indirect/area_lights.h"
#include "08_indirect/scene.h"
#include "tests/08_indirect/step.h"

#include <cmath>
#include <vector>

namespace rt {

/// Returns the irradiance from the scene's area lights: red channel, in units of pi.
inline Mean received(Scene& scene, vec3 position, vec3 normal, int samples = 20'000, std::uint64_t seed = 3) {
    build_bvhs(scene);
    const AreaLights lights = collect_area_lights(scene);
    Random random(seed);
    Mean mean;
    for (int i = 0; i < samples; ++i)
        mean.add(double(sample_area_lights(scene, lights, facing(position, normal), random).x / pi));
    return mean;
}

/// Returns the form factor by Lambert's formula, in units of pi: the cosine-weighted share of a uniformly
/// bright hemisphere that a polygon fills. It is 1 / (2 pi) sum theta_i gamma_i . n over the edges; the whole
/// polygon must be above the surface.
inline double form_factor(const std::vector<vec3>& polygon, vec3 position, vec3 normal) {
    using glm::dvec3;
    double sum = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const dvec3 a = normalize(dvec3(polygon[i]) - dvec3(position));
        const dvec3 b = normalize(dvec3(polygon[(i + 1) % polygon.size()]) - dvec3(position));
        sum += std::acos(dot(a, b)) * dot(normalize(cross(a, b)), dvec3(normal));
    }
    return std::abs(sum) / (2 * double(pi));
}
inline std::vector<vec3> corners_of(const Quad& quad) {
    return {quad.corner, quad.corner + quad.edge_u, quad.corner + quad.edge_u + quad.edge_v,
            quad.corner + quad.edge_v};
}

inline void add_triangle(Scene& scene, vec3 a, vec3 b, vec3 c, int material) {
    const auto first = std::uint32_t(scene.mesh.positions.size());
    for (const vec3 corner : {a, b, c}) {
        scene.mesh.positions.push_back(corner);
        scene.mesh.normals.push_back(normalize(cross(b - a, c - a)));
        scene.mesh.uvs.push_back(vec2(0));
    }
    scene.mesh.triangles.push_back({first, first + 1, first + 2});
    scene.mesh.materials.push_back(material);
}

} // namespace rt
