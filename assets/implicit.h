// Shapes as signed distances (negative inside), and the smooth union that lets them grow together like clay.
// The distances need not be exact: the polygoniser only asks where they are zero and which way they grow.
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

/// (|q| - 1) / |gradient of |q||, q = (point - centre) / radii: a distance to first order.
inline double ellipsoid(dvec3 point, dvec3 centre, dvec3 radii) {
    const dvec3 scaled = (point - centre) / radii;
    const double slope = std::max(length(scaled / radii), 1e-9); // 0 in the very centre
    return length(scaled) * (length(scaled) - 1) / slope;
}

/// The share of the way from a to b, in [0, 1], at which the segment passes `point`.
inline double share_along(dvec3 point, dvec3 a, dvec3 b) {
    return std::clamp(dot(point - a, b - a) / dot(b - a, b - a), 0.0, 1.0);
}

/// A capsule whose radius goes from `radius_a` to `radius_b`.
inline double cone(dvec3 point, dvec3 a, dvec3 b, double radius_a, double radius_b) {
    const double share = share_along(point, a, b);
    return distance(point, mix(a, b, share)) - glm::mix(radius_a, radius_b, share);
}

/// A tube along a cubic Bezier curve whose radius goes from `radius_begin` to `radius_end`.
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
    double share;    ///< of the way along the tube
    double distance; ///< from its surface
};

/// The place on the tube nearest to `point`; the tube is a chain of cones.
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

/// Central differences over 2 h. A larger h smooths creases.
inline dvec3 gradient(const Distance& shape, dvec3 point, double h) {
    const dvec3 x(h, 0, 0), y(0, h, 0), z(0, 0, h);
    const dvec3 rise(shape(point + x) - shape(point - x), shape(point + y) - shape(point - y),
                     shape(point + z) - shape(point - z));
    return rise / (2 * h);
}

/// Newton's method along the gradient: the point of the surface near `point`.
inline dvec3 project_to_surface(const Distance& shape, dvec3 point) {
    for (int step = 0; step < 4; ++step) {
        const dvec3 slope = gradient(shape, point, 1e-5);
        point -= shape(point) * slope / std::max(dot(slope, slope), 1e-6);
    }
    return point;
}

} // namespace rt::assets
