// Lambertian surfaces (chalk, paper, plaster): the same radiance in every direction.
#pragma once

#include "01_spheres/hit.h"

namespace rt {

struct Diffuse {
    vec3 albedo;             ///< the share of the light that comes back, in [0, 1]
    vec3 emission = vec3(0); ///< radiance that it sends out by itself, W / (m^2 sr)
};

/// Returns a purely emissive surface: constant radiance, independent of the incoming light. In step 08 it is
/// a light source.
inline Diffuse emissive(vec3 radiance) {
    return {vec3(0), radiance};
}

/// Lambert's law: returns the radiance for irradiance E (W/m^2), emission + albedo / pi E, the same in all
/// directions. pi is the integral of the cosine over the hemisphere: with albedo 1, all incoming light leaves
/// again.
inline vec3 outgoing_radiance(const Diffuse& diffuse, vec3 irradiance) {
    //> how much leaves towards the eye: of the light that arrives, and of the surface's own?
    return diffuse.emission + diffuse.albedo / pi * irradiance;
    //< return vec3(0);
}

/// Returns the diffuse surface at a hit. Patterns (a checkerboard, an image in step 06) overload this: they
/// change which colour is where, not how light travels.
template <typename S>
Diffuse matte_at(const Diffuse& diffuse, const S&, const Hit&) {
    return diffuse;
}

} // namespace rt
