// A pinhole camera: from a point of the image to the ray that sees it.
#pragma once

#include "01_spheres/ray.h"

#include <cmath>

namespace rt {

/// Where a camera is and what it looks at.
struct LookAt {
    vec3 from{0, 0, 0};
    vec3 at{0, 0, -1};
    vec3 up{0, 1, 0};
    float fov = 40; ///< degrees, from the lower to the upper edge of the picture
    dvec3 origin{
        0}; ///< of `from` and `at` in the coordinates that the user types (step 05: of a model's file)
};

struct Camera {
    vec3 origin;
    vec3 forward;     ///< unit
    vec3 half_width;  ///< to the right: half the picture's width at distance 1
    vec3 half_height; ///< upward: half the picture's height at distance 1
    vec2 resolution;  ///< of the picture, in pixels
};

/// `width` and `height` in pixels. `look_at.at` must differ from `look_at.from`, and `look_at.up` must not
/// point along the line between them.
inline Camera make_camera(const LookAt& look_at, int width, int height) {
    const vec3 forward = normalize(look_at.at - look_at.from);
    const vec3 right = normalize(cross(forward, look_at.up));
    //> at distance 1, how far is it from the middle of the picture to its upper and to its right edge?
    const float half_height = std::tan(glm::radians(look_at.fov) / 2);
    const float half_width = half_height * float(width) / float(height);
    //< const float half_height = 1, half_width = 1;
    return {look_at.from, forward, half_width * right, half_height * cross(right, forward),
            vec2(width, height)};
}

/// Returns the ray through a point of the image: (0, 0) is its top left corner, (width, height) the bottom
/// right one, so the center of pixel (x, y) is (x + .5, y + .5). The direction has unit length.
inline Ray camera_ray(const Camera& camera, vec2 film_point) {
    //> which direction leads from the eye through this point of the film? Mind which way y goes
    const float x = 2 * film_point.x / camera.resolution.x - 1;
    const float y = 1 - 2 * film_point.y / camera.resolution.y;
    return {camera.origin, normalize(camera.forward + x * camera.half_width + y * camera.half_height)};
    //< return {camera.origin, camera.forward};
}

/// Returns the position of sample `index` in its pixel, in [0, 1)^2: the center first, then evenly by the
/// generalised golden ratio g = 1.3247..., g^3 = g + 1 (Roberts 2018, "The Unreasonable Effectiveness of
/// Quasirandom Sequences"). Step 07 compares better choices.
inline vec2 r2_offset(int index) {
    const glm::dvec2 step(0.7548776662466927, 0.5698402909980532); // 1/g and 1/g^2
    return min(vec2(fract(0.5 + double(index) * step)), vec2(0x1.fffffep-1f));
}

} // namespace rt
