// Triangulates polygons, including concave ones.
#pragma once

#include "common/math/vec.h"

#include <array>
#include <vector>

namespace rt {

/// Triangulates a simple polygon of n >= 3 vertices in space: n - 2 triangles of the same orientation, each
/// as three indices into `corners`. A polygon that crosses itself or has no area gets some triangulation.
/// Takes about n log n time, and up to 64 times as long for a polygon that crosses itself.
std::vector<std::array<int, 3>> triangulate(const std::vector<vec3>& corners);

} // namespace rt
