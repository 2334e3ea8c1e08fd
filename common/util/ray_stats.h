// What the rays of this thread have cost so far: plain counts, added up over the threads after a render.
#pragma once

#include <cstdint>

namespace rt {

struct RayStats {
    std::uint64_t rays = 0;           ///< scene queries (`intersect` or `occluded`)
    std::uint64_t box_tests = 0;      ///< boxes tested on the way through a hierarchy
    std::uint64_t triangle_tests = 0; ///< triangles tested

    RayStats& operator+=(const RayStats& other) {
        rays += other.rays;
        box_tests += other.box_tests;
        triangle_tests += other.triangle_tests;
        return *this;
    }
};

inline thread_local RayStats ray_stats;

} // namespace rt
