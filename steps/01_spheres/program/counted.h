// A scene whose rays are counted, for the rays per second that a program prints.
#pragma once

#include "01_spheres/ray.h"
#include "common/util/ray_stats.h"

namespace rt {

/// Behaves as `Scene` does, and counts the queries in `ray_stats`: these overloads are better matches than those of the
/// scene's shapes.
template <typename Scene>
struct Counted : Scene {};

template <typename Scene>
auto intersect(const Counted<Scene>& scene, const Ray& ray) {
    ++ray_stats.rays;
    return intersect(static_cast<const Scene&>(scene), ray);
}

template <typename Scene>
bool occluded(const Counted<Scene>& scene, const Ray& ray) {
    ++ray_stats.rays;
    return occluded(static_cast<const Scene&>(scene), ray);
}

} // namespace rt
