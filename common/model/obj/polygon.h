// A polygon cut into triangles, also where it is not convex.
#pragma once

#include "common/math/vec.h"

#include <array>
#include <vector>

namespace rt {

/// Cuts a simple polygon of n >= 3 corners in space into n - 2 triangles of the same sense of rotation, each
/// three positions in `corners`. One that crosses itself, or has no area, is cut somehow. Takes about n log n
/// time, and 64 times that where it crosses itself.
std::vector<std::array<int, 3>> triangulate(const std::vector<vec3>& corners);

} // namespace rt
