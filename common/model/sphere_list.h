// Reads a list of spheres from a CSV file, so that scenes made by other programs can be shown.
#pragma once

#include "common/math/vec.h"

#include <string>
#include <vector>

namespace rt {

struct SphereRecord {
    enum class Kind { matte, metal, glass };
    Kind kind = Kind::matte;
    vec3 center{0};
    float radius = 1; ///< > 0
    vec3 albedo{0};   ///< linear RGB in [0, 1]
    float fuzz = 0;   ///< of metal, in [0, 1]
    float ior = 1.5f; ///< of glass, in [1, 10]
};

/// Reads a list of spheres. The first line names the columns:
/// material,x,y,z,radius,red,green,blue,fuzz_or_ior. Each further line is a sphere; its material is
/// lambertian, metal or dielectric. Throws Error with path and line if a line is invalid.
std::vector<SphereRecord> read_sphere_list(const std::string& path);

} // namespace rt
