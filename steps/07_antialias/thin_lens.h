// Thin lens: all rays of one image point pass through the lens and converge on the plane of focus (Cook,
// Porter and Carpenter 1984).
#pragma once

#include "01_spheres/camera.h"
#include "07_antialias/sampler.h"

#include <cmath>

namespace rt {

/// Draws a point of the unit disk, uniformly by area: the square's rings become rings and its diagonals
/// stay straight, so that what is even in the square is even in the disk (the concentric map of Shirley and
/// Chiu 1997). u in [0, 1)^2.
inline vec2 sample_disk_concentric(vec2 u) {
    //> to which radius and to which angle does this point of the square go?
    const vec2 p = 2.0f * u - 1.0f;
    if (p == vec2(0)) return p;
    if (std::abs(p.x) > std::abs(p.y)) {
        const float angle = pi / 4 * (p.y / p.x);
        return p.x * vec2(std::cos(angle), std::sin(angle));
    }
    const float angle = pi / 4 * (p.x / p.y);
    return p.y * vec2(std::sin(angle), std::cos(angle));
    //< return 2.0f * u - 1.0f;
}

struct ThinLens {
    float aperture_diameter = 0; ///< how wide it is, in metres; 0 is the pinhole
    float focus_distance = 1;    ///< how far ahead the plane in focus is, in metres along `forward`, above 0
};

/// As camera_ray(), but from the point of the lens that u in [0, 1)^2 selects. The lens is centered at the
/// camera's origin, perpendicular to `forward`. A point d metres ahead appears as a disk, the circle of
/// confusion, whose diameter on the plane of focus is aperture_diameter |d - focus_distance| / d.
inline Ray thin_lens_ray(const Camera& camera, const ThinLens& lens, vec2 film_point, vec2 u) {
    const Ray ray = camera_ray(camera, film_point);
    if (lens.aperture_diameter == 0) return ray;
    //> which point is in focus along this ray, and how is it reached from elsewhere on the lens?
    const vec3 focus_point =
        ray.direction * (lens.focus_distance / dot(ray.direction, camera.forward)); // from the origin
    const vec2 p = lens.aperture_diameter / 2 * sample_disk_concentric(u);
    const vec3 lens_offset = p.x * normalize(camera.half_width) + p.y * normalize(camera.half_height);
    return {ray.origin + lens_offset, normalize(focus_point - lens_offset)};
    //< return ray;
}

/// Returns the ray of a sample through this point of the image. A pinhole camera draws no random numbers.
inline Ray sample_camera_ray(const Camera& camera, const ThinLens& lens, vec2 film_point, Sampler& sampler) {
    return lens.aperture_diameter > 0 ? thin_lens_ray(camera, lens, film_point, sampler.get_2d())
                                      : camera_ray(camera, film_point);
}

} // namespace rt
