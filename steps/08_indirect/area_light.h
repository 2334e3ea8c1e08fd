// Area lights: surfaces that glow, asked directly instead of waiting for a path to find them.
#pragma once

#include "02_shadows/light.h"
#include "03_mirror/quad.h"
#include "04_refraction/glass.h"
#include "05_mesh_bvh/mesh.h"
#include "common/image.h"
#include "common/match.h"
#include "common/random.h"

#include <algorithm>
#include <variant>
#include <vector>

namespace rt {

/// A point of a light, where the surface faces, and its density over the light's area, 1/m^2.
struct LightPoint {
    vec3 position;
    vec3 normal;
    float density;
};

struct LightTriangle {
    vec3 a, b, c;
};

inline float area(const Quad& quad) {
    return length(cross(quad.edge_u, quad.edge_v));
}

inline float area(const LightTriangle& triangle) {
    return length(area_normal({triangle.a, triangle.b, triangle.c})) / 2;
}

inline float area(const Sphere& sphere) {
    return 4 * pi * sphere.radius * sphere.radius;
}

/// Points spread evenly over a shape, from u in [0, 1)^2.
inline LightPoint light_point(const Quad& quad, vec2 u) {
    return {quad.corner + u.x * quad.edge_u + u.y * quad.edge_v, normalize(cross(quad.edge_u, quad.edge_v)),
            1 / area(quad)};
}

/// A square folded along its diagonal would do; this warp keeps neighbours together (Osada et al. 2002, 4.2).
inline LightPoint light_point(const LightTriangle& triangle, vec2 u) {
    //> weights 1 - sqrt(u.x), sqrt(u.x) (1 - u.y) and sqrt(u.x) u.y
    const float root = std::sqrt(u.x);
    const vec3 position = (1 - root) * triangle.a + root * (1 - u.y) * triangle.b + root * u.y * triangle.c;
    //< const vec3 position = triangle.a;
    return {position, normalize(area_normal({triangle.a, triangle.b, triangle.c})), 1 / area(triangle)};
}

/// Archimedes: slices of equal height have equal area. Half of the points face away and shed nothing.
inline LightPoint light_point(const Sphere& sphere, vec2 u) {
    const float z = 1 - 2 * u.x;
    const float radius = std::sqrt(glm::max(0.0f, 1 - z * z));
    const vec3 normal(radius * std::cos(2 * pi * u.y), radius * std::sin(2 * pi * u.y), z);
    return {sphere.center + sphere.radius * normal, normal, 1 / area(sphere)};
}

struct AreaLight {
    std::variant<Quad, LightTriangle, Sphere> shape;
    vec3 emission; ///< radiance, W / (m^2 sr)
};

/// All area lights of a scene, to be picked in proportion to their power.
struct AreaLights {
    std::vector<AreaLight> list;
    std::vector<float> cumulative; ///< cumulative[i]: the share of lights 0 to i in the power of all
};

/// What the material sends out by itself.
template <typename S>
vec3 emission(const S& scene, int material) {
    return match(
        scene.materials[std::size_t(material)], [](const Diffuse& diffuse) { return diffuse.emission; },
        [](const Textured& textured) { return textured.emission; },
        [&](const Reflective& coat) { return (1 - coat.reflectivity) * emission(scene, coat.base); },
        [](const auto&) { return vec3(0); });
}

/// Gathers the quads, triangles and spheres that glow. A plane is endless and has no area to pick from: it
/// must not glow.
template <typename S>
AreaLights area_lights(const S& scene) {
    AreaLights lights;
    double power = 0;
    std::vector<double> sums;
    const auto collect = [&](const auto& shape, int material) {
        const vec3 radiance = emission(scene, material);
        const double share = double(luminance(radiance)) * double(area(shape));
        if (!(share > 0)) return;
        lights.list.push_back({shape, radiance});
        sums.push_back(power += share);
    };
    for (const Quad& quad : scene.quads) collect(quad, quad.material);
    for (const Sphere& sphere : scene.spheres) collect(sphere, sphere.material);
    for (std::uint32_t i = 0; i < scene.mesh.triangles.size(); ++i) {
        const auto [a, b, c] = corners(scene.mesh, i);
        collect(LightTriangle{a, b, c}, scene.mesh.materials[i]);
    }
    for (const double sum : sums) lights.cumulative.push_back(float(sum / power));
    return lights;
}

/// An estimate of the irradiance at the hit from all area lights, W/m^2: one point of one light, and
///     E ~ L cos(theta) cos(theta_light) V / (r^2 p),   p = the density of the point over all lights' area.
/// The light shines to both sides; V is 1 if the two points see each other, else 0.
/// `absorption` is that of the medium between them.
template <CastsShadows S>
vec3 area_light(const S& scene, const AreaLights& lights, const Hit& hit, Random& random,
                vec3 absorption = vec3(0)) {
    if (lights.list.empty()) return vec3(0);
    const float pick = random.uniform();
    const auto chosen = std::ranges::upper_bound(lights.cumulative, pick);
    const auto index = std::min(std::size_t(chosen - lights.cumulative.begin()), lights.list.size() - 1);
    const float below = index > 0 ? lights.cumulative[index - 1] : 0;
    const float probability = lights.cumulative[index] - below;
    const AreaLight& light = lights.list[index];
    const vec2 u = random.uniform2();
    const LightPoint point = match(light.shape, [&](const auto& shape) { return light_point(shape, u); });
    //> both cosines over the squared distance, divided by the density, if nothing stands between
    const vec3 way = point.position - hit.position;
    const float squared = dot(way, way);
    const float cosine = dot(way, hit.normal);                   // times r
    const float light_cosine = std::abs(dot(way, point.normal)); // times r
    if (cosine <= 0 || light_cosine == 0) return vec3(0);
    const vec3 arriving =
        light.emission * cosine * light_cosine / (squared * squared * point.density * probability);
    const float side = dot(way, point.normal) < 0 ? 1.0f : -1.0f; // stop just before the light itself
    const vec3 before = side * position_error(hit.position, point.position) * point.normal;
    return occluded(scene, segment_to(hit, point.position + before))
               ? vec3(0)
               : arriving * transmittance(absorption, std::sqrt(squared));
    //< return vec3(0);
}

} // namespace rt
