// A pinhole camera: from a point of the picture to the ray that sees it.
#pragma once

#include "01_spheres/ray.h"
#include "common/util/error.h"
#include "common/cli/options.h"

#include <cmath>

namespace rt {

/// Where a camera stands and what it looks at.
struct Pose {
    vec3 from{0, 0, 0};
    vec3 at{0, 0, -1};
    vec3 up{0, 1, 0};
    float fov = 40; ///< degrees, from the lower to the upper edge of the picture
    dvec3 origin{
        0}; ///< of `from` and `at` in the coordinates that the user types (step 05: of a model's file)
};

struct Camera {
    vec3 origin;
    vec3 forward; ///< unit
    vec3 right;   ///< half the picture's width at distance 1
    vec3 up;      ///< half the picture's height at distance 1
    vec2 size;    ///< of the picture, in pixels
};

/// `width` and `height` in pixels. `pose.at` must differ from `pose.from`, and `pose.up` must not point along
/// the line between them.
inline Camera make_camera(const Pose& pose, int width, int height) {
    const vec3 forward = normalize(pose.at - pose.from);
    const vec3 right = normalize(cross(forward, pose.up));
    //> half the picture's height at distance 1 is the tangent of half the angle; the width follows its shape
    const float half_height = std::tan(glm::radians(pose.fov) / 2);
    const float half_width = half_height * float(width) / float(height);
    //< const float half_height = 1, half_width = 1;
    return {pose.from, forward, half_width * right, half_height * cross(right, forward), vec2(width, height)};
}

/// `pixel` is a point of the picture: (0, 0) its top left corner, (width, height) its bottom right one, so
/// that the middle of pixel (x, y) is (x + .5, y + .5). The direction has unit length.
inline Ray camera_ray(const Camera& camera, vec2 pixel) {
    //> map the picture to [-1, 1] x [-1, 1], with y upward, and add up the three axes
    const float x = 2 * pixel.x / camera.size.x - 1;
    const float y = 1 - 2 * pixel.y / camera.size.y;
    return {camera.origin, normalize(camera.forward + x * camera.right + y * camera.up)};
    //< return {camera.origin, camera.forward};
}

/// Where sample `index` of a pixel lies within it, in [0, 1)^2: the middle first, then spread evenly by the
/// generalised golden ratio g = 1.3247..., g^3 = g + 1 (Roberts 2018, "The Unreasonable Effectiveness of
/// Quasirandom Sequences"). Step 07 asks what a good choice would be.
inline vec2 in_pixel(int index) {
    const glm::dvec2 step(0.7548776662466927, 0.5698402909980532); // 1/g and 1/g^2
    return min(vec2(fract(0.5 + double(index) * step)), vec2(0x1.fffffep-1f));
}

/// Declares --from --at --up --fov.
class CameraKnobs {
  public:
    CameraKnobs(Options& all, const Pose& initial)
        : options(all), from(all.knob("from", initial.from, "where the camera stands, metres")),
          at(all.knob("at", initial.at, "the point it looks at, metres")),
          up(all.knob("up", initial.up, "the direction that is up in the picture")),
          fov(all.knob("fov", initial.fov, 1.0f, 170.0f, "vertical field of view, degrees")) {}

    /// What the user asked for. Throws Error if no camera can stand like that.
    Pose pose() const { return checked({vec3(from), vec3(at), vec3(up), fov}); }

    /// `other`, overridden by the options given on the command line.
    Pose pose(const Pose& other) const {
        Pose pose = other;
        if (options.given("from")) pose.from = vec3(from - other.origin);
        if (options.given("at")) pose.at = vec3(at - other.origin);
        if (options.given("up")) pose.up = vec3(up);
        if (options.given("fov")) pose.fov = fov;
        return checked(pose);
    }

  private:
    static Pose checked(const Pose& pose) {
        const vec3 sight = pose.at - pose.from;
        if (length(sight) == 0) throw Error("--from and --at are the same point: move one of them");
        if (!(length(cross(normalize(sight), pose.up)) > 1e-6f * length(pose.up)))
            throw Error("--up must not be zero or point along the line from --from to --at");
        return pose;
    }

    const Options& options;
    const dvec3& from;
    const dvec3& at;
    const dvec3& up;
    const float& fov;
};

} // namespace rt
