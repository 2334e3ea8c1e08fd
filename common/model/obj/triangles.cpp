// Triangulates faces and flips those that wind against their normals.
// Such a face was mirrored, or written by a program with another winding convention. The normals are what the
// author saw on screen, so the order of the vertices follows them.
#include "common/model/obj/triangles.h"

#include "common/model/obj/polygon.h"

#include <algorithm>
#include <cmath>

namespace rt {
namespace {

constexpr float least_contradiction = 0.05f; // cosine; smoothed normals of thin parts may lie in the face

/// Returns the vector along the normal whose length is twice the area. T is vec3 or dvec3.
template <typename T>
T area_vector(const ObjModel& file, const std::array<ObjIndex, 3>& triangle) {
    const T a(file.positions[std::size_t(triangle[0].position)]);
    return cross(T(file.positions[std::size_t(triangle[1].position)]) - a,
                 T(file.positions[std::size_t(triangle[2].position)]) - a);
}

/// Returns whether a triangle has an area. Float precision decides for most triangles. Where squares
/// underflow or overflow, double decides; a height of 2^-22 of the longest side counts as rounding error.
bool has_area(const ObjModel& file, const std::array<ObjIndex, 3>& triangle) {
    const vec3 area = area_vector<vec3>(file, triangle);
    const float square = dot(area, area);
    if (square > 0 && std::isfinite(square)) return true;
    const dvec3 a(file.positions[std::size_t(triangle[0].position)]);
    const dvec3 b(file.positions[std::size_t(triangle[1].position)]);
    const dvec3 c(file.positions[std::size_t(triangle[2].position)]);
    const double side = std::max({distance(a, b), distance(b, c), distance(c, a)});
    return length(cross(b - a, c - a)) > 0x1p-22 * side * side;
}

} // namespace

void Triangles::add(const std::array<ObjIndex, 3>& triangle, const FaceTraits& traits) {
    if (!has_area(file, triangle)) {
        ++dropped;
        return;
    }
    file.triangles.push_back(triangle);
    file.triangle_materials.push_back(traits.material);
    if (with_smoothing) file.smoothing_groups.push_back(traits.smoothing);
}

void Triangles::add_face(std::span<const ObjIndex> corners, const FaceTraits& traits) {
    const std::size_t begin = file.triangles.size();
    if (corners.size() == 3) {
        add({corners[0], corners[1], corners[2]}, traits);
    } else {
        std::vector<vec3> places;
        for (const ObjIndex& corner : corners) places.push_back(file.positions[std::size_t(corner.position)]);
        for (const auto& [a, b, c] : triangulate(places))
            add({corners[std::size_t(a)], corners[std::size_t(b)], corners[std::size_t(c)]}, traits);
    }
    if (!winds_against(corners, begin)) return;
    const std::size_t n = corners.size();
    for (std::size_t i = 0; i < (n == 3 ? 1 : n); ++i)
        keys.emplace_back(key(corners[(i + 2) % n], corners[(i + 1) % n], corners[i]), against.size());
    against.push_back({begin, file.triangles.size()});
}

/// Returns whether a face winds against its normals. `begin` is its first triangle. The face is judged as a
/// whole, so that its triangles stay on one side.
bool Triangles::winds_against(std::span<const ObjIndex> corners, std::size_t begin) const {
    vec3 sum(0), area(0);
    for (const ObjIndex& corner : corners) {
        if (corner.normal < 0) return false;
        sum += file.normals[std::size_t(corner.normal)];
    }
    for (std::size_t i = begin; i < file.triangles.size(); ++i)
        area += area_vector<vec3>(file, file.triangles[i]);
    if (!(dot(area, sum) < 0)) return false;
    double lengths = 0;
    for (const ObjIndex& corner : corners) lengths += length(file.normals[std::size_t(corner.normal)]);
    return dot(dvec3(area), dvec3(sum)) < -least_contradiction * lengths * length(dvec3(area));
}

TriangleKey Triangles::key(const ObjIndex& a, const ObjIndex& b, const ObjIndex& c) const {
    TriangleKey key{};
    for (std::size_t i = 0; const ObjIndex& corner : {a, b, c}) {
        const vec3 p = file.positions[std::size_t(corner.position)];
        key[i++] = {p.x, p.y, p.z};
    }
    std::rotate(key.begin(), std::min_element(key.begin(), key.end()), key.end());
    return key;
}

/// Marks faces that are the back of another face with the same vertices. Every triangulation of a polygon
/// contains triangles of three consecutive vertices, so one such triangle of the front that equals three
/// consecutive vertices of the back shows that the two belong together.
void Triangles::find_backs() {
    std::ranges::sort(keys);
    auto next = against.begin();
    for (std::size_t i = 0; i < file.triangles.size(); ++i) {
        while (next != against.end() && next->end <= i) ++next;
        if (next != against.end() && next->begin <= i) continue;
        const auto& [a, b, c] = file.triangles[i];
        const TriangleKey front = key(a, b, c);
        auto back = std::ranges::lower_bound(keys, front, {}, &decltype(keys)::value_type::first);
        for (; back != keys.end() && back->first == front; ++back) against[back->second].is_back = true;
    }
}

std::size_t Triangles::turn_faces() {
    if (against.empty()) return 0;
    find_backs();
    for (const Against& face : against)
        for (std::size_t i = face.begin; i < face.end; ++i)
            std::swap(file.triangles[i][1], file.triangles[i][2]);
    return std::size_t(std::ranges::count(against, false, &Against::is_back));
}

} // namespace rt
