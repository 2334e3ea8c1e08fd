// Matte surfaces: chalk, paper, plaster. They look equally bright from everywhere.
#pragma once

#include "01_spheres/hit.h"

namespace rt {

struct Diffuse {
    vec3 albedo;             ///< the share of the light that comes back, in [0, 1]
    vec3 emission = vec3(0); ///< radiance that it sends out by itself, W / (m^2 sr)
};

/// The flat shader: one radiance from every side whatever light there is. In step 08 it becomes a lamp.
inline Diffuse emissive(vec3 radiance) {
    return {vec3(0), radiance};
}

/// Lambert's law: irradiance E (W/m^2) leaves a matte surface as radiance albedo / pi E, the same in all
/// directions. The pi is the integral of the cosine over the half-sphere: with albedo 1, all that came leaves
/// again.
inline vec3 outgoing_radiance(const Diffuse& diffuse, vec3 irradiance) {
    //> emission, and albedo / pi of what arrives
    return diffuse.emission + diffuse.albedo / pi * irradiance;
    //< return vec3(0);
}

/// What is matte at a hit. Patterns (a checkerboard, in step 06 an image) overload this, so that light need not know
/// them: they change which colour is where, not how light travels.
template <typename S>
Diffuse matte_at(const Diffuse& diffuse, const S&, const Hit&) {
    return diffuse;
}

} // namespace rt
