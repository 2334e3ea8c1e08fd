// Fuzz target for a list of spheres: all numbers are in range.
#include "common/model/sphere_list.h"
#include "tests/fuzz/fuzz.h"

#include <cmath>

namespace rt::fuzz {

void run_sphere_list(std::string_view bytes) {
    const std::string path = write_input("spheres.csv", bytes);
    std::vector<SphereRecord> spheres;
    if (!refusal([&] { spheres = read_sphere_list(path); }).empty()) return;
    require(!spheres.empty(), "a list has spheres");
    for (const SphereRecord& sphere : spheres) {
        require(sphere.radius >= 1e-6f && sphere.radius <= 1e6f, "radii are in [1e-6, 1e6]");
        require(sphere.fuzz >= 0 && sphere.fuzz <= 1, "the fuzz is in [0, 1]");
        require(sphere.ior >= 1 && sphere.ior <= 10, "the index of refraction is in [1, 10]");
        for (int i = 0; i < 3; ++i) {
            require(std::abs(sphere.center[i]) <= 1e6f, "centres are within 1e6");
            require(sphere.albedo[i] >= 0 && sphere.albedo[i] <= 1, "albedos are in [0, 1]");
        }
    }
}

} // namespace rt::fuzz
