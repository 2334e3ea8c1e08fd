// Counts the work done for rays, per thread; a render adds up the counts of its threads.
#pragma once

#include <cstdint>

namespace rt {

struct RayStats {
    std::uint64_t rays = 0;           ///< scene queries (`intersect` or `occluded`)
    std::uint64_t box_tests = 0;      ///< boxes tested while traversing a hierarchy
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
