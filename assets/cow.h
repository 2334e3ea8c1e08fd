// The cow: barrel body, short legs, a large head, and one black patch over one eye.
#pragma once

#include "assets/animal.h"
#include "assets/noise.h"

namespace rt::assets::cow {

inline constexpr Colour white = hex(0xfbf6ec), black = hex(0x33282a), pink = hex(0xf2a9a8),
                        lips = hex(0x8d4a50);

inline const dvec3 muzzle_centre{0.55, 0.665, 0}, muzzle_radii{0.135, 0.12, 0.175};
inline const dvec3 eye_centre{0.46, 0.835, 0.105};
inline const Frame eye_frame(eye_centre, {1, 0, 0.35}, {0, 1, 0});
inline const Frame ear_frame({0.27, 0.855, 0.28}, {1, 0.25, -0.15}, {-0.05, -0.02, 0.25});
inline const dvec3 neck_low{0.08, 0.52, 0}, neck_high{0.32, 0.74, 0};
inline const Frame collar_frame(mix(neck_low, neck_high, 0.5), neck_high - neck_low, {0, 1, 0});
inline const dvec3 bell_centre{0.37, 0.465, 0};
inline const dvec3 udder_centre{-0.30, 0.25, 0}, udder_radii{0.13, 0.10, 0.12};
inline const dvec3 forelock_centre{0.40, 0.985, 0}, forelock_radii{0.09, 0.05, 0.085};
inline const dvec3 tuft_centre{-0.66, 0.25, 0.06}, tuft_radii{0.05, 0.085, 0.05};
inline const Tube horn{
    {{{0.33, 0.94, 0.09}, {0.31, 0.99, 0.20}, {0.36, 1.03, 0.22}, {0.40, 1.10, 0.18}}}, 0.052, 0.036};
inline const Tube tail_tube{
    {{{-0.46, 0.58, 0}, {-0.66, 0.70, 0.02}, {-0.64, 0.42, 0.04}, {-0.66, 0.28, 0.06}}}, 0.04, 0.03};

inline double legs(dvec3 m) {
    const double front = cone(m, {0.13, 0.40, 0.13}, {0.15, 0.06, 0.145}, 0.10, 0.078);
    const double back = cone(m, {-0.37, 0.40, 0.13}, {-0.38, 0.06, 0.15}, 0.11, 0.078);
    const double front_hoof = cone(m, {0.155, 0.05, 0.145}, {0.165, 0.03, 0.145}, 0.085, 0.09);
    const double back_hoof = cone(m, {-0.375, 0.05, 0.15}, {-0.365, 0.03, 0.15}, 0.085, 0.09);
    return std::min(smooth_union(front, front_hoof, 0.03), smooth_union(back, back_hoof, 0.03));
}

inline double udder(dvec3 m) {
    const double front = cone(m, {-0.25, 0.20, 0.05}, {-0.245, 0.145, 0.06}, 0.036, 0.028);
    const double back = cone(m, {-0.35, 0.20, 0.05}, {-0.355, 0.145, 0.06}, 0.036, 0.028);
    return smooth_union(ellipsoid(m, udder_centre, udder_radii), std::min(front, back), 0.03);
}

inline double body(dvec3 m) {
    const double barrel = ellipsoid(m, {-0.12, 0.48, 0}, {0.40, 0.245, 0.255});
    const double shoulders = ellipsoid(m, {0.08, 0.49, 0}, {0.22, 0.23, 0.22});
    const double hips = ellipsoid(m, {-0.34, 0.51, 0}, {0.18, 0.21, 0.22});
    const double neck = cone(m, neck_low, neck_high, 0.19, 0.14);
    double shape = smooth_union(barrel, smooth_union(shoulders, hips, 0.1), 0.1);
    shape = smooth_union(shape, neck, 0.12);
    shape = smooth_union(shape, legs(m), 0.08);
    return smooth_union(shape, udder(m), 0.04);
}

/// A leaf shape in the ear's local coordinates (across, along, toward the front), hollow in front.
inline double ear(dvec3 m) {
    const dvec3 q = ear_frame.to_local(m);
    const double leaf = ellipsoid(q, dvec3(0), {0.082, 0.155, 0.05});
    const double hollow = ellipsoid(q, {0, 0.015, 0.06}, {0.055, 0.11, 0.035});
    return smooth_difference(leaf, hollow, 0.03);
}

inline double muzzle(dvec3 m) {
    const double snout = ellipsoid(m, muzzle_centre, muzzle_radii);
    return smooth_difference(snout, sphere(m, {0.68, 0.705, 0.065}, 0.028), 0.025);
}

inline double head(dvec3 m) {
    const double skull = ellipsoid(m, {0.35, 0.81, 0}, {0.195, 0.19, 0.195});
    double shape = smooth_union(skull, ellipsoid(m, {0.43, 0.75, 0}, {0.15, 0.14, 0.16}), 0.08);
    shape = smooth_union(shape, muzzle(m), 0.05);
    shape = smooth_union(shape, ear(m), 0.03);
    shape = smooth_union(shape, distance_to(horn, m), 0.02);
    shape = smooth_union(shape, ellipsoid(m, forelock_centre, forelock_radii), 0.03);
    return smooth_union(shape, sphere(m, eye_centre, 0.09), 0.02);
}

/// A flat band around the neck, in the plane across it.
inline double collar(dvec3 point) {
    const dvec3 q = collar_frame.to_local(point);
    return ellipse({length(dvec2(q.x, q.y)), q.z}, {0.165, 0}, {0.042, 0.036});
}

inline double bell(dvec3 point) {
    return sphere(point, bell_centre, 0.072);
}

inline double tail(dvec3 point) {
    return smooth_union(distance_to(tail_tube, point), ellipsoid(point, tuft_centre, tuft_radii), 0.02);
}

inline double shape(dvec3 point) {
    const dvec3 m = mirrored(point);
    double shape = smooth_union(body(m), head(m), 0.06);
    shape = smooth_union(shape, collar(point), 0.012);
    shape = smooth_union(shape, bell(point), 0.012);
    shape = smooth_union(shape, tail(point), 0.04);
    return smooth_intersection(shape, -point.y, 0.02);
}

struct Blot {
    dvec3 centre;
    double radius;
};

/// Large blots at chosen places, with irregular borders from noise.
inline double spots(dvec3 point) {
    constexpr std::array<Blot, 10> blots{{
        // clang-format off
        {{0.02, 0.68, 0.18}, 0.17},   {{-0.34, 0.62, 0.16}, 0.18}, // on the right side
        {{-0.14, 0.33, 0.24}, 0.13},  {{0.14, 0.30, 0.20}, 0.09},
        {{-0.16, 0.66, -0.16}, 0.20}, {{0.12, 0.45, -0.22}, 0.12}, // on the left side
        {{-0.44, 0.42, -0.18}, 0.15}, {{-0.50, 0.60, -0.02}, 0.10},
        {{0.38, 0.86, 0.16}, 0.13},   {{0.26, 0.88, -0.20}, 0.11}, // right eye, left ear
        // clang-format on
    }};
    double nearest = 1e9;
    for (const auto& [centre, radius] : blots) nearest = std::min(nearest, distance(point, centre) - radius);
    return nearest + 0.09 * fractal_noise(6.0 * point, 2);
}

inline double inner_ear(dvec3 m) {
    const dvec3 q = ear_frame.to_local(m);
    return std::max({ellipse({q.x, q.y}, {0, 0.008}, {0.052, 0.112}), -q.z, ear(m) - 0.01});
}

/// The part of the neck between two planes, so that the band's borders stay straight
/// where the mesh is coarse.
inline double collar_band(dvec3 point) {
    return std::max(std::abs(collar_frame.to_local(point).z) - 0.038, collar(point) - 0.03);
}

/// Paints the lashes, white, iris and pupil, and a bright and a faint reflection.
inline Colour paint_eye(Colour colour, dvec3 point) {
    const dvec3 q = eye_frame.to_local(mirrored(point));
    if (q.z < 0) return colour;
    const dvec2 flat(q.x, q.y);
    colour = over(colour, hex(0x2a1d1a), ellipse(flat, {0, 0.006}, {0.076, 0.080}), 0.003);
    colour = over(colour, hex(0xfffdf8), ellipse(flat, {0, -0.002}, {0.066, 0.072}), 0.003);
    colour = over(colour, hex(0x5a3620), ellipse(flat, {-0.012, -0.008}, {0.044, 0.052}), 0.003);
    colour = over(colour, hex(0x17100e), ellipse(flat, {-0.012, -0.008}, {0.033, 0.041}), 0.003);
    const dvec2 shine = point.z > 0 ? dvec2(0.006, 0.016) : dvec2(-0.030, 0.016); // both eyes alike
    colour = over(colour, hex(0xffffff), ellipse(flat, shine, {0.014, 0.015}), 0.002);
    return over(colour, hex(0xd8c8b8), ellipse(flat, {-0.012, -0.034}, {0.012, 0.006}), 0.004);
}

inline Colour paint_muzzle(Colour colour, dvec3 point) {
    const dvec3 m = mirrored(point);
    const double rim = ellipsoid(m, muzzle_centre + dvec3(0.012, -0.004, 0), muzzle_radii + 0.004);
    colour = over(colour, hex(0xf4b6b4), rim, 0.008);
    if (point.x < 0.5) return colour;
    colour = over(colour, lips, ellipse({m.z, point.y}, {0.066, 0.704}, {0.021, 0.025}), 0.004);
    const double smile = std::abs(point.y - (0.605 + 2.4 * m.z * m.z)) - 0.006; // a parabola around the chin
    return over(colour, lips, std::max(smile, m.z - 0.115), 0.003);
}

/// Paints the bell: brass with a raised band, and below that a slit that ends in a hole.
inline Colour paint_bell(Colour colour, dvec3 point) {
    const dvec3 q = point - bell_centre;
    const double slit = std::max(std::abs(q.z) - 0.006, std::abs(q.y + 0.045) - 0.022);
    const double hole = ellipse({q.z, q.y}, {0, -0.022}, {0.014, 0.014});
    Colour brass = over(hex(0xf2b93a), hex(0xc98a1c), std::abs(q.y - 0.008) - 0.007, 0.003);
    brass = over(brass, hex(0x4a2c0c), std::max(std::min(slit, hole), -q.x), 0.003);
    return over(colour, brass, bell(point) - 0.007, 0.004);
}

inline Colour hide(dvec3 point) {
    const dvec3 m = mirrored(point);
    Colour colour = over(white, black, spots(point), 0.005);
    colour = over(colour, pink, udder(m) - 0.012, 0.006);
    colour = over(colour, hex(0x4a3b39), m.y - 0.085, 0.004); // hooves
    colour = over(colour, black, ear(m) - 0.01, 0.006);
    colour = over(colour, pink, inner_ear(m), 0.005);
    colour = over(colour, black, ellipsoid(m, forelock_centre, forelock_radii + 0.006), 0.005);
    colour = over(colour, hex(0xefdcae), distance_to(horn, m) - 0.006, 0.008);
    colour = over(colour, black, ellipsoid(point, tuft_centre, tuft_radii + 0.01), 0.01);
    colour = over(colour, hex(0xc8323c), collar_band(point), 0.003);
    return paint_eye(paint_muzzle(paint_bell(colour, point), point), point);
}

inline const Animal animal{"cow", {{-0.85, -0.1, -0.55}, {0.8, 1.2, 0.55}}, shape, hide, white};

} // namespace rt::assets::cow
