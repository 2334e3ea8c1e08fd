// Vertex normals: averages the normals of the faces around a vertex.
#pragma once

#include "common/model/obj_file.h"

#include <array>
#include <vector>

namespace rt {

/// Returns the outward normal, as long as twice the area. In double: squares of small numbers underflow in
/// float.
inline dvec3 area_normal(const std::array<vec3, 3>& vertices) {
    const dvec3 a(vertices[0]);
    return cross(dvec3(vertices[1]) - a, dvec3(vertices[2]) - a);
}

/// Returns a normal for each corner of each triangle of a model. Faces around a vertex are averaged, weighted
/// by area, unless they differ by more than `crease_angle` degrees (a sphere is smooth, a cube keeps its
/// edges), or unless the file puts them into different smoothing groups, or into none.
std::vector<std::array<vec3, 3>> smooth_normals(const ObjModel& file, float crease_angle);

} // namespace rt
