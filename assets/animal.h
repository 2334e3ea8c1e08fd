// An animal: a smooth shape built from simple bodies, and a hide painted in space.
#pragma once

#include "assets/bake.h"
#include "assets/polygonise.h"
#include "assets/unwrap.h"

#include <string>

namespace rt::assets {

/// An animal about one unit tall, standing on y = 0 and facing +x; its right side is at +z.
struct Animal {
    std::string name;
    Box bounds;
    Distance shape;
    PaintFunction hide;
    Colour ground; ///< texture colour between the charts
};

/// Returns the point mirrored to the animal's right half: most parts come in pairs.
inline dvec3 mirrored(dvec3 point) {
    return {point.x, point.y, std::abs(point.z)};
}

/// The local coordinates of a part: `right`, `up` and `forward` are orthonormal.
struct Frame {
    dvec3 origin, right, up, forward;

    Frame(dvec3 at, dvec3 looking, dvec3 roughly_up)
        : origin(at), right(normalize(cross(looking, roughly_up))), up(cross(right, normalize(looking))),
          forward(normalize(looking)) {}

    dvec3 to_local(dvec3 point) const {
        return {dot(point - origin, right), dot(point - origin, up), dot(point - origin, forward)};
    }
};

/// Returns the signed distance to an ellipse around `centre` in the plane, to first order.
inline double ellipse(dvec2 point, dvec2 centre, dvec2 radii) {
    return ellipsoid({point, 0}, {centre, 0}, {radii, 1});
}

} // namespace rt::assets
