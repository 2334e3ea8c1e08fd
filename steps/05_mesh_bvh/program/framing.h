// Frames an unknown model: camera, floor and key light from its bounding box alone.
#pragma once

#include "01_spheres/camera.h"
#include "05_mesh_bvh/mesh.h"

#include <cmath>

namespace rt {

struct Framing {
    LookAt look_at;        ///< shows the whole model from the front, slightly from the right and above
    vec3 floor;            ///< a point of the floor, just below the model
    vec3 key_light;        ///< position of the light, beside the camera and well above the model
    float intensity_scale; ///< metres^2: this many W/sr give about 1 W/m^2 on the model
};

/// Returns the framing of a model with this box. `aspect` is the image's width over its height. A model
/// without extent is treated as having a radius of 1 m.
inline Framing frame_model(const Aabb& box, float aspect) {
    const vec3 center = centroid(box);
    const float radius = length(box.max - box.min) > 0 ? length(box.max - box.min) / 2 : 1;
    const float fov = 34;
    const float half_angle = std::atan(std::tan(glm::radians(fov) / 2) * glm::min(aspect, 1.0f));
    const float camera_distance = 1.02f * radius / std::sin(half_angle); // the bounding sphere just fits
    const vec3 key_light = center + radius * vec3(-1.6f, 3.2f, 2.4f);
    return {{center + camera_distance * normalize(vec3(0.45f, 0.32f, 1)), center, {0, 1, 0}, fov},
            {center.x, box.min.y - 0x1p-12f * radius, center.z}, // below a floor that the model may have
            key_light,
            dot(key_light - center, key_light - center)};
}

} // namespace rt
