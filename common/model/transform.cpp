// Places a model in a scene.
#include "common/model/obj_file.h"

#include <cmath>

namespace rt {

void transform(ObjModel& file, float scale, float rotation_y, vec3 translation) {
    const float c = std::cos(glm::radians(rotation_y)), s = std::sin(glm::radians(rotation_y));
    const auto rotated = [&](vec3 p) { return vec3(c * p.x + s * p.z, p.y, c * p.z - s * p.x); };
    for (vec3& position : file.positions) position = scale * rotated(position) + translation;
    for (vec3& normal : file.normals) normal = rotated(normal);
    file.origin = dvec3(0);
}

} // namespace rt
