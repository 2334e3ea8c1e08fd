// What the checks of bounces, metals and lamps share: normals, and the deviation of means and counts.
#pragma once

#include "01_spheres/hit.h"
#include "common/math/random.h"
#include "tests/check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace rt {

inline const std::array<vec3, 9> normals{vec3(0, 1, 0),
                                         vec3(0, 0, 1),
                                         vec3(0, 0, -1),
                                         vec3(-1, 0, 0),
                                         normalize(vec3(0.3f, -0.5f, -0.9f)),
                                         normalize(vec3(1, 2, -2)),
                                         normalize(vec3(-0.4f, 0.2f, 0.7f)),
                                         normalize(vec3(1e-4f, -2e-4f, -1)),
                                         normalize(vec3(3, -1, -1e-6f))};

/// Returns by how many standard errors the mean deviates; 0 if the difference is within rounding.
inline double off(const Mean& mean, double want) {
    return std::abs(mean.mean() - want) <= 1e-5 * std::max(1.0, std::abs(want)) ? 0 : std::abs(mean.z(want));
}

/// Returns a hit at a point that receives light.
inline Hit facing(vec3 position, vec3 normal) {
    return {0, position, normal, normal, vec2(0), 0, false, position_error(position, position)};
}

/// Returns Pearson's chi-square of observed and expected counts.
inline double chi_square(const std::vector<double>& found, const std::vector<double>& expected) {
    double sum = 0;
    for (std::size_t i = 0; i < found.size(); ++i)
        sum += (found[i] - expected[i]) * (found[i] - expected[i]) / expected[i];
    return sum;
}

/// Returns the azimuth around `normal` in [0, 1), measured from a perpendicular direction chosen here.
inline double azimuth(vec3 normal, vec3 direction) {
    using glm::dvec3;
    const dvec3 n(normal);
    const dvec3 right = normalize(cross(n, std::abs(n.x) < 0.6 ? dvec3(1, 0, 0) : dvec3(0, 1, 0)));
    const double angle = std::atan2(dot(cross(n, right), dvec3(direction)), dot(right, dvec3(direction)));
    return std::min(angle / (2 * double(pi)) + 0.5, 0.9999999);
}

} // namespace rt
