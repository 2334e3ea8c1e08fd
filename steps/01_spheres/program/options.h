// The options of every step's program: the camera and the view.
#pragma once

#include "01_spheres/camera.h"
#include "01_spheres/debug_view.h"
#include "common/cli/options.h"
#include "common/util/error.h"

namespace rt {

/// Declares --view.
inline Choice<DebugView> view_option(Options& options) {
    return options.choice("view", {"light", "normal", "depth", "uv", "material", "hits", "work"},
                          DebugView::radiance,
                          "what to show: the light, or what the ray hits (its normal, its distance, "
                          "its texture coordinates, its material, how many surfaces are along the ray, and, "
                          "from step 05 on, how much work finding the closest hit takes)");
}

/// Declares --from --at --up --fov.
class CameraOptions {
  public:
    CameraOptions(Options& all, const LookAt& initial)
        : options(all), from(all.option("from", initial.from, "position of the camera, metres")),
          at(all.option("at", initial.at, "point that the camera looks at, metres")),
          up(all.option("up", initial.up, "direction that is up in the image")),
          fov(all.option("fov", initial.fov, 1.0f, 170.0f, "vertical field of view, degrees")) {}

    /// Returns the camera given on the command line. Throws Error if its directions are degenerate.
    LookAt look_at() const { return validated({vec3(from), vec3(at), vec3(up), fov}); }

    /// Returns `defaults`, overridden by the options given on the command line. Throws Error like look_at().
    LookAt look_at_or(const LookAt& defaults) const {
        LookAt look_at = defaults;
        if (options.is_set("from")) look_at.from = vec3(from - defaults.origin);
        if (options.is_set("at")) look_at.at = vec3(at - defaults.origin);
        if (options.is_set("up")) look_at.up = vec3(up);
        if (options.is_set("fov")) look_at.fov = fov;
        return validated(look_at);
    }

  private:
    static LookAt validated(const LookAt& look_at) {
        const vec3 view_direction = look_at.at - look_at.from;
        if (length(view_direction) == 0) throw Error("--from and --at are the same point: move one of them");
        if (!(length(cross(normalize(view_direction), look_at.up)) > 1e-6f * length(look_at.up)))
            throw Error("--up must not be zero or point along the line from --from to --at");
        return look_at;
    }

    const Options& options;
    const dvec3& from;
    const dvec3& at;
    const dvec3& up;
    const float& fov;
};

} // namespace rt
