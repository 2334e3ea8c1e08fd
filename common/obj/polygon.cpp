// A polygon cut into triangles by clipping ears (Meisters, American Mathematical Monthly, 1975).
// tinyobjloader's own cut depends on where the origin lies and cuts concave quads along the wrong diagonal,
// so it is not used.
#include "common/obj/polygon.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace rt {
namespace {

using glm::dvec2;
using glm::dvec3;

/// Twice the signed area of the triangle a, b, c: positive if it turns counter-clockwise.
double turn(dvec2 a, dvec2 b, dvec2 c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Newell's normal: its length is twice the area, whatever the shape.
dvec3 newell_normal(const std::vector<vec3>& corners) {
    const dvec3 origin(corners.front()); // differences keep their digits far from the origin
    dvec3 normal(0.0);
    for (std::size_t i = 0; i < corners.size(); ++i)
        normal += cross(dvec3(corners[i]) - origin, dvec3(corners[(i + 1) % corners.size()]) - origin);
    return normal;
}

/// Seen from the tip of its normal, along the axis that shows it largest: counter-clockwise in the plane.
std::vector<dvec2> flattened(const std::vector<vec3>& corners) {
    const dvec3 normal = newell_normal(corners);
    int axis = 0;
    for (int i = 1; i < 3; ++i) {
        if (std::abs(normal[i]) > std::abs(normal[axis])) axis = i;
    }
    const int right = (axis + 1) % 3, up = (axis + 2) % 3;
    const double side = normal[axis] < 0 ? -1 : 1;
    std::vector<dvec2> flat;
    for (const vec3& corner : corners) flat.emplace_back(side * double(corner[right]), double(corner[up]));
    return flat;
}

/// What is left of a polygon while its ears are clipped.
struct Ring {
    const std::vector<dvec2>& flat;
    std::vector<int> rest;

    int at(std::size_t i) const { return rest[i % rest.size()]; }
    dvec2 point(std::size_t i) const { return flat[std::size_t(at(i))]; }
    std::array<int, 3> triangle(std::size_t i) const { return {at(i), at(i + 1), at(i + 2)}; }

    /// The corner i + 1 is an ear if it turns left and nothing of the polygon reaches into its triangle. Only
    /// a corner that does not turn left can be the first to do so.
    bool is_ear(std::size_t i) const {
        const dvec2 a = point(i), b = point(i + 1), c = point(i + 2);
        if (!(turn(a, b, c) > 0)) return false;
        for (std::size_t j = i + 3; j < i + rest.size(); ++j) {
            const dvec2 p = point(j);
            if (p == a || p == b || p == c || turn(point(j - 1), p, point(j + 1)) > 0) continue;
            if (turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0) return false;
        }
        return true;
    }
};

/// A quad along its shorter diagonal, if that lies inside.
std::vector<std::array<int, 3>> cut_quad(const std::vector<vec3>& corners, const std::vector<dvec2>& flat) {
    const auto half = [&](std::size_t i, std::size_t j, std::size_t k) {
        return turn(flat[i], flat[j], flat[k]);
    };
    const bool inside_02 = half(0, 1, 2) > 0 && half(0, 2, 3) > 0;
    const bool inside_13 = half(0, 1, 3) > 0 && half(1, 2, 3) > 0;
    const bool shorter_13 = distance(corners[1], corners[3]) < distance(corners[0], corners[2]);
    if (inside_13 && (!inside_02 || shorter_13)) return {{0, 1, 3}, {1, 2, 3}};
    return {{0, 1, 2}, {0, 2, 3}};
}

} // namespace

std::vector<std::array<int, 3>> cut_polygon(const std::vector<vec3>& corners) {
    if (corners.size() == 3) return {{0, 1, 2}};
    const std::vector<dvec2> flat = flattened(corners);
    if (corners.size() == 4) return cut_quad(corners, flat);
    std::vector<std::array<int, 3>> triangles;
    Ring ring{flat, std::vector<int>(corners.size())};
    std::iota(ring.rest.begin(), ring.rest.end(), 0);
    for (std::size_t start = 0; ring.rest.size() > 3;) {
        std::size_t ear = start; // going round, rather than back to the first, makes better triangles
        while (ear < start + ring.rest.size() && !ring.is_ear(ear)) ++ear;
        triangles.push_back(ring.triangle(ear));
        const std::size_t tip = (ear + 1) % ring.rest.size();
        ring.rest.erase(ring.rest.begin() + std::ptrdiff_t(tip));
        start = tip % ring.rest.size();
    }
    triangles.push_back(ring.triangle(0));
    return triangles;
}

} // namespace rt
