// Dielectrics (glass, water): refraction, total internal reflection, the Fresnel equations, absorption.
#pragma once

#include "03_mirror/mirror.h"

#include <cmath>

namespace rt {

/// A medium that light travels in.
struct Medium {
    float ior = 1;                  ///< index of refraction: 1 air, 1.333 water, 1.5 glass, 2.417 diamond
    vec3 absorption_coefficient{0}; ///< sigma_a, 1/m; what is left after d metres is exp(-sigma_a d)
};

/// A smooth interface between two media. It names both, so a bubble of air in glass is {air, glass}.
struct Dielectric {
    Medium interior;
    Medium exterior{};
};

/// Returns the fraction of the light that is left after `distance` metres (Beer-Lambert).
inline vec3 transmittance(vec3 absorption_coefficient, float distance) {
    //> which share of each colour is left after this distance?
    return exp(-absorption_coefficient * distance);
    //< return vec3(1);
}

/// Snell's law: sin_t = eta sin_i with eta = n_i / n_t. Returns cos_t >= 0, or nothing for total internal
/// reflection. cos_i in [0, 1].
inline std::optional<float> cos_transmitted(float cos_i, float eta) {
    //> what does Snell's law, which is about sines, say about the cosine beyond, and when is there none?
    const float cos_t_squared = (1 - eta * eta) + eta * eta * cos_i * cos_i;
    if (cos_t_squared <= 0) return std::nullopt;
    return std::sqrt(cos_t_squared);
    //< return cos_i;
}

/// Returns the reflectance of a smooth interface for unpolarised light, in [0, 1]: the mean of Fresnel's two
/// polarisations, r_s = (eta c_i - c_t) / (eta c_i + c_t) and r_p = (c_i - eta c_t) / (c_i +
/// eta c_t), squared.
inline float fresnel_dielectric(float cos_i, float eta) {
    //> which share of unpolarised light is reflected, and which where nothing gets through?
    const auto cos_t = cos_transmitted(cos_i, eta);
    if (!cos_t) return 1;
    const float s = (eta * cos_i - *cos_t) / (eta * cos_i + *cos_t);
    const float p = (cos_i - eta * *cos_t) / (cos_i + eta * *cos_t);
    return (s * s + p * p) / 2;
    //< return 0;
}

/// Returns the refracted direction, of the same length as `direction`, or nothing for total internal
/// reflection. `normal` is unit and faces `direction`. Snell in vector form: the tangent part is scaled by
/// eta.
inline std::optional<vec3> refract(vec3 direction, vec3 normal, float eta) {
    const float magnitude = length(direction);
    const float cos_i = glm::min(-dot(direction, normal) / magnitude, 1.0f);
    //> which way does the light go on, at the same length, if it gets through at all?
    const auto cos_t = cos_transmitted(cos_i, eta);
    if (!cos_t) return std::nullopt;
    return eta * direction + magnitude * (eta * cos_i - *cos_t) * normal;
    //< return direction;
}

/// An interface as a ray meets it: its reflectance, the medium on the ray's side and the one beyond.
struct Interface {
    Medium incident_medium;
    Medium transmitted_medium;
    float reflectance;
};

inline Interface make_interface(const Dielectric& dielectric, const Ray& ray, const Hit& hit) {
    const Medium& incident = hit.back_face ? dielectric.interior : dielectric.exterior;
    const Medium& transmitted = hit.back_face ? dielectric.exterior : dielectric.interior;
    const float cos_i =
        glm::clamp(-dot(ray.direction, hit.shading_normal) / length(ray.direction), 0.0f, 1.0f);
    return {incident, transmitted, fresnel_dielectric(cos_i, incident.ior / transmitted.ior)};
}

/// Returns the refracted ray, or nothing for total internal reflection.
inline std::optional<Ray> refracted_ray(const Ray& ray, const Hit& hit, const Interface& interface) {
    const auto direction = refract(ray.direction, hit.shading_normal,
                                   interface.incident_medium.ior / interface.transmitted_medium.ior);
    if (!direction) return std::nullopt;
    return spawn_ray(hit, *direction);
}

} // namespace rt
