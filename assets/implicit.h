// Shapes as signed distances (negative inside), and the smooth union that blends them.
// The distances need not be exact: the polygoniser only uses where they are zero and their gradient.
#pragma once

#include "assets/mesh.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace rt::assets {

using Distance = std::function<double(dvec3)>;

inline double sphere(dvec3 point, dvec3 centre, double radius) {
    return distance(point, centre) - radius;
}

/// Returns the distance to an ellipsoid to first order: (|q| - 1) / |gradient of |q||, q =
/// (point - centre) / radii.
inline double ellipsoid(dvec3 point, dvec3 centre, dvec3 radii) {
    const dvec3 scaled = (point - centre) / radii;
    const double slope = std::max(length(scaled / radii), 1e-9); // 0 at the centre
    return length(scaled) * (length(scaled) - 1) / slope;
}

/// Returns the parameter in [0, 1] of the point of the segment from a to b that is closest to `point`.
inline double share_along(dvec3 point, dvec3 a, dvec3 b) {
    return std::clamp(dot(point - a, b - a) / dot(b - a, b - a), 0.0, 1.0);
}

/// Returns the signed distance to a capsule whose radius changes linearly from `radius_a` to `radius_b`.
inline double cone(dvec3 point, dvec3 a, dvec3 b, double radius_a, double radius_b) {
    const double share = share_along(point, a, b);
    return distance(point, mix(a, b, share)) - glm::mix(radius_a, radius_b, share);
}

/// A tube along a cubic Bezier curve, whose radius changes linearly from `radius_begin` to `radius_end`.
struct Tube {
    std::array<dvec3, 4> points;
    double radius_begin, radius_end;

    dvec3 centre(double share) const {
        const dvec3 a = mix(points[0], points[1], share), b = mix(points[1], points[2], share),
                    c = mix(points[2], points[3], share);
        return mix(mix(a, b, share), mix(b, c, share), share);
    }
    double radius(double share) const { return glm::mix(radius_begin, radius_end, share); }
};

struct TubePlace {
    double share;    ///< parameter along the tube, in [0, 1]
    double distance; ///< signed distance from its surface
};

/// Returns the place on the tube closest to `point`. The tube is approximated by a chain of cones.
inline TubePlace nearest_on(const Tube& tube, dvec3 point) {
    constexpr int links = 14;
    TubePlace nearest{0, 1e9};
    for (int link = 0; link < links; ++link) {
        const double begin = double(link) / links, end = double(link + 1) / links;
        const dvec3 a = tube.centre(begin), b = tube.centre(end);
        const double distance = cone(point, a, b, tube.radius(begin), tube.radius(end));
        if (distance < nearest.distance) nearest = {glm::mix(begin, end, share_along(point, a, b)), distance};
    }
    return nearest;
}

inline double distance_to(const Tube& tube, dvec3 point) {
    return nearest_on(tube, point).distance;
}

/// Polynomial smooth minimum: where a and b differ by less than `width`, a fillet replaces the crease.
inline double smooth_union(double a, double b, double width) {
    const double overlap = std::max(width - std::abs(a - b), 0.0) / width;
    return std::min(a, b) - overlap * overlap * width / 4;
}

inline double smooth_intersection(double a, double b, double width) {
    return -smooth_union(-a, -b, width);
}

inline double smooth_difference(double a, double b, double width) {
    return smooth_intersection(a, -b, width);
}

/// Returns the gradient by central differences over 2 h. A larger h smooths creases.
inline dvec3 gradient(const Distance& shape, dvec3 point, double h) {
    const dvec3 x(h, 0, 0), y(0, h, 0), z(0, 0, h);
    const dvec3 rise(shape(point + x) - shape(point - x), shape(point + y) - shape(point - y),
                     shape(point + z) - shape(point - z));
    return rise / (2 * h);
}

/// Returns a point of the surface near `point`, by Newton's method along the gradient.
inline dvec3 project_to_surface(const Distance& shape, dvec3 point) {
    for (int step = 0; step < 4; ++step) {
        const dvec3 slope = gradient(shape, point, 1e-5);
        point -= shape(point) * slope / std::max(dot(slope, slope), 1e-6);
    }
    return point;
}

} // namespace rt::assets
