// Area lights: surfaces that glow, asked directly instead of waiting for a path to find them.
#pragma once

#include "02_shadows/point_light.h"
#include "03_mirror/quad.h"
#include "04_refraction/dielectric.h"
#include "05_mesh_bvh/mesh.h"
#include "06_textures/texture.h"
#include "08_indirect/bounce.h"
#include "common/image/image.h"
#include "common/util/match.h"

#include <algorithm>
#include <limits>
#include <variant>
#include <vector>

namespace rt {

/// A point of a light, where the surface faces, and the radiance that it sends out, W / (m^2 sr).
struct LightPoint {
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

/// Points spread evenly over a shape, from u in [0, 1)^2; in double and rounded once, so that a shadow ray
/// that ends `relative_epsilon` before one does not meet the light itself.
inline LightPoint light_point(const Quad& quad, vec2 u) {
    const dvec3 across = double(u.x) * dvec3(quad.edge_u) + double(u.y) * dvec3(quad.edge_v);
    return {vec3(dvec3(quad.corner) + across), normalize(cross(quad.edge_u, quad.edge_v))};
}

/// A square folded along its diagonal would do; this warp keeps neighbours together (Osada et al. 2002, 4.2).
inline LightPoint light_point(const LightTriangle& triangle, vec2 u) {
    //> weights 1 - sqrt(u.x), sqrt(u.x) (1 - u.y) and sqrt(u.x) u.y
    const double root = std::sqrt(u.x), v = u.y;
    const dvec3 a(triangle.a), b(triangle.b), c(triangle.c);
    const vec3 position((1 - root) * a + root * (1 - v) * b + root * v * c);
    //< const vec3 position = triangle.a;
    return {position, vec3(normalize(area_normal({triangle.a, triangle.b, triangle.c})))};
}

/// Half of the points face away and shed nothing.
inline LightPoint light_point(const Sphere& sphere, vec2 u) {
    const dvec3 normal = normalize(dvec3(unit_vector(u)));
    return {vec3(dvec3(sphere.center) + double(sphere.radius) * normal), vec3(normal)};
}

struct AreaLight {
    std::variant<Quad, LightTriangle, Sphere> shape;
    vec3 emission; ///< radiance, W / (m^2 sr)
};

/// All area lights of a scene, to be picked in proportion to their power.
struct AreaLights {
    std::vector<AreaLight> list;
    std::vector<float> cumulative; ///< cumulative[i]: the share of lights 0 to i in the power of all
    float power = 0;               ///< of all: luminance(emission) times area, summed up
};

/// What the material sends out by itself.
template <typename S>
vec3 emission(const S& scene, int material) {
    return match(
        scene.materials[std::size_t(material)], [](const Diffuse& diffuse) { return diffuse.emission; },
        [](const Textured& textured) { return textured.emission; },
        [&](const Coated& coat) { return (1 - coat.reflectivity) * emission(scene, coat.base); },
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
    lights.power = float(power);
    return lights;
}

/// A point of one of the lights, u in [0, 1)^2. Picked by power and then evenly, it has the density
/// luminance(emission) / power over the area of all lights, whichever light it lies on.
inline LightPoint light_point(const AreaLights& lights, vec2 u) {
    const auto chosen = std::ranges::upper_bound(lights.cumulative, u.x);
    const auto index = std::min(std::size_t(chosen - lights.cumulative.begin()), lights.list.size() - 1);
    const float below = index > 0 ? lights.cumulative[index - 1] : 0;
    u.x = (u.x - below) / (lights.cumulative[index] - below); // what the choice leaves is uniform again
    u.x = glm::clamp(u.x, 0.0f, 0x1.fffffep-1f);
    const AreaLight& light = lights.list[index];
    LightPoint point = match(light.shape, [&](const auto& shape) { return light_point(shape, u); });
    point.emission = light.emission;
    return point;
}

/// The density, 1/sr, with which a surface picks the direction of such a point, which it sees at `distance`
/// and under an angle of this cosine to the light's normal. The area dA fills the directions dA cos /
/// distance^2, so
///     p(w) = p(A) distance^2 / cos,   p(A) = luminance(emission) / power.
inline float light_pdf(const AreaLights& lights, vec3 emission, float distance, float cosine) {
    if (lights.list.empty()) return 0;
    const float density = luminance(emission) / lights.power * distance * distance / std::abs(cosine);
    return glm::min(density, std::numeric_limits<float>::max()); // seen edge-on
}

/// Two ways find the same light, with densities p and q. The share that counts where the first one finds it:
/// the power heuristic with exponent 2 (Veach and Guibas 1995),  p^2 / (p^2 + q^2).  Both shares add up to 1.
/// p > 0.
inline float share(float p, float q) {
    //> by way of q / p, whose square does not overflow where those of p and q do
    const float ratio = q / p;
    return 1 / (1 + ratio * ratio);
    //< return 1;
}

/// An estimate of the irradiance at the hit from all area lights, W/m^2: one point of one light, and
///     E ~ L cos(theta) V / p,   p = the density of the point's direction.
/// The light shines to both sides; V is 1 if the two points see each other, else 0. `absorption` is that of
/// the medium between them. `rivals`: the spread of bounces that look for the same lights and take their
/// share.
template <Occludable S, UniformSource Source>
vec3 area_light(const S& scene, const AreaLights& lights, const Hit& hit, Source& source,
                vec3 absorption = vec3(0), const Spread* rivals = nullptr) {
    if (lights.list.empty()) return vec3(0);
    const LightPoint point = light_point(lights, source.uniform2());
    //> the light over its density, times the cosine and the share, if nothing stands between
    const vec3 way = point.position - hit.position;
    const float distance = length(way);
    const float cosine = dot(way, hit.shading_normal) / distance;
    const float light_cosine = dot(way, point.normal) / distance;
    if (!(cosine > 0) || light_cosine == 0) return vec3(0);
    const float density = light_pdf(lights, point.emission, distance, light_cosine);
    const float weight = rivals ? share(density, bounce_pdf(*rivals, cosine)) : 1;
    const float side = light_cosine < 0 ? 1.0f : -1.0f; // stop just before the light itself
    const vec3 before = side * position_error(hit.position, point.position) * point.normal;
    if (occluded(scene, spawn_ray_to(hit, point.position + before))) return vec3(0);
    const vec3 arriving = point.emission * (cosine * weight / density);
    return absorption == vec3(0) ? arriving : arriving * transmittance(absorption, distance);
    //< return vec3(0);
}

} // namespace rt
