// The cat: sitting, smiling, with a curled tail; a ginger tabby with cream chest and paws.
#pragma once

#include "assets/animal.h"
#include "assets/noise.h"

namespace rt::assets::cat {

inline constexpr Colour stripe = hex(0xb85a1e), cream = hex(0xfff0d8), pink = hex(0xf4aaa6),
                        ink = hex(0x6b3a2c);

inline const dvec3 eye_centre{0.185, 0.775, 0.105};
inline const Frame eye_frame(eye_centre, {1, 0, 0.4}, {0, 1, 0});
inline const Frame ear_frame({0.05, 0.88, 0.12}, {1, 0.1, 0.25}, {-0.05, 0.17, 0.035});
inline const dvec3 nose_centre{0.285, 0.728, 0}, nose_radii{0.030, 0.028, 0.040};
inline const dvec3 collar_centre{0.04, 0.585, 0}, tag_centre{0.20, 0.545, 0};
inline const Tube tail_low{
    {{{-0.24, 0.10, -0.02}, {-0.60, -0.02, 0}, {-0.60, 0.30, 0.02}, {-0.50, 0.42, 0.04}}}, 0.065, 0.055};
inline const Tube tail_high{
    {{{-0.50, 0.42, 0.04}, {-0.41, 0.52, 0.06}, {-0.46, 0.68, 0.07}, {-0.60, 0.65, 0.08}}}, 0.055, 0.047};

inline double paws(dvec3 m) {
    const double front = ellipsoid(m, {0.19, 0.045, 0.092}, {0.095, 0.06, 0.062});
    const double back = cone(m, {0.03, 0.05, 0.22}, {0.14, 0.045, 0.25}, 0.055, 0.062);
    return smooth_union(front, back, 0.03);
}

inline double body(dvec3 m) {
    const double trunk = cone(m, {-0.10, 0.22, 0}, {0.03, 0.56, 0}, 0.225, 0.13);
    const double chest = ellipsoid(m, {0.075, 0.44, 0}, {0.13, 0.18, 0.145});
    const double haunch = ellipsoid(m, {-0.05, 0.17, 0.17}, {0.19, 0.165, 0.105});
    const double leg = cone(m, {0.10, 0.40, 0.09}, {0.15, 0.06, 0.092}, 0.072, 0.056);
    double shape = smooth_union(trunk, chest, 0.1);
    shape = smooth_union(shape, haunch, 0.05);
    shape = smooth_union(shape, leg, 0.05);
    return smooth_union(shape, paws(m), 0.03);
}

/// A flattened cone in the ear's local coordinates (across, along, toward the front), hollow in front.
inline double ear(dvec3 m) {
    const dvec3 q = ear_frame.to_local(m) * dvec3(1, 1, 1.25);
    const double leaf = cone(q, dvec3(0), {0, 0.15, 0}, 0.105, 0.034);
    const double hollow = cone(q, {0, 0.02, 0.12}, {0, 0.11, 0.085}, 0.066, 0.03);
    return smooth_difference(leaf, hollow, 0.03) / 1.25;
}

inline double muzzle(dvec3 m) {
    const double puff = ellipsoid(m, {0.245, 0.69, 0.045}, {0.065, 0.052, 0.062});
    const double chin = ellipsoid(m, {0.235, 0.65, 0}, {0.05, 0.04, 0.05});
    return smooth_union(puff, chin, 0.02);
}

inline double head(dvec3 m) {
    const double skull = ellipsoid(m, {0.07, 0.765, 0}, {0.195, 0.18, 0.235});
    const double cheek = ellipsoid(m, {0.12, 0.705, 0.12}, {0.11, 0.09, 0.12});
    double shape = smooth_union(skull, cheek, 0.08);
    shape = smooth_union(shape, muzzle(m), 0.03);
    shape = smooth_union(shape, ear(m), 0.03);
    shape = smooth_union(shape, sphere(m, eye_centre, 0.088), 0.02);
    return smooth_union(shape, ellipsoid(m, nose_centre, nose_radii), 0.025);
}

/// A band around the neck.
inline double collar(dvec3 point) {
    const dvec3 q = point - collar_centre;
    return ellipse({length(dvec2(q.x, q.z)), q.y}, {0.135, 0}, {0.034, 0.03});
}

inline double tag(dvec3 point) {
    return sphere(point, tag_centre, 0.043);
}

inline double tail(dvec3 point) {
    return std::min(distance_to(tail_low, point), distance_to(tail_high, point));
}

inline double shape(dvec3 point) {
    const dvec3 m = mirrored(point);
    double shape = smooth_union(body(m), head(m), 0.05);
    shape = smooth_union(shape, std::min(collar(point), tag(point)), 0.012);
    shape = smooth_union(shape, tail(point), 0.04);
    return smooth_intersection(shape, -point.y, 0.02);
}

/// Returns the signed distance to stripes along a coordinate, negative inside. `share` is the fraction of
/// each period that is stripe; where it falls to 0 or below, stripes taper to a point.
inline double stripes(double along, double period, double share) {
    const double phase = along / period - std::floor(along / period);
    return (std::abs(phase - 0.5) - share / 2) * period;
}

inline double tail_rings(dvec3 point) {
    const TubePlace low = nearest_on(tail_low, point), high = nearest_on(tail_high, point);
    const double along = low.distance < high.distance ? 0.55 * low.share : 0.55 + 0.4 * high.share;
    return stripes(along, 0.115, 0.5);
}

inline double beyond(double value, double limit) {
    return std::max(value - limit, 0.0);
}

/// Returns the signed distance to the stripes around the back, along the crown and across the cheeks. Each
/// kind tapers where its part of the body ends.
inline double coat_stripes(dvec3 point) {
    if (tail(point) < 0.005) return tail_rings(point);
    const dvec3 m = mirrored(point);
    const double wave = 0.05 * fractal_noise(7.0 * point, 2);
    const double back_share = 0.5 - 4 * beyond(m.x, -0.12) - 8 * beyond(m.y, 0.5);
    if (m.y < collar_centre.y) return stripes(m.y + 0.6 * m.x + wave, 0.105, back_share);
    const double crown_share = 0.5 - 14 * beyond(m.z, 0.05) - 12 * beyond(0.86, m.y);
    const double cheek_share = 6 * (m.z - 0.15) - 12 * beyond(std::abs(m.y - 0.71), 0.06);
    return std::min(stripes(m.z + 0.3 * wave + 0.0275, 0.055, crown_share),
                    stripes(m.y - 0.25 * m.x + wave, 0.065, cheek_share));
}

inline double inner_ear(dvec3 m) {
    const dvec3 q = ear_frame.to_local(m);
    const double triangle = cone({q.x, q.y, 0}, {0, 0.02, 0}, {0, 0.13, 0}, 0.068, 0.012);
    return std::max({triangle, -q.z, ear(m) - 0.01});
}

/// The part of the neck between two planes, so that the band's borders stay straight
/// where the mesh is coarse.
inline double collar_band(dvec3 point) {
    return std::max(std::abs(point.y - collar_centre.y) - 0.03, collar(point) - 0.03);
}

/// Paints the rim, the iris, a wide slit pupil, and two reflections.
inline Colour paint_eye(Colour colour, dvec3 point) {
    const dvec3 q = eye_frame.to_local(mirrored(point));
    if (q.z < -0.05) return colour;
    const dvec2 flat(q.x, q.y);
    colour = over(colour, hex(0x3a2016), ellipse(flat, {0, 0}, {0.074, 0.077}), 0.003);
    const Colour iris = mix(hex(0xd8ea6a), hex(0x3f9d5a), glm::smoothstep(-0.05, 0.05, q.y));
    colour = over(colour, iris, ellipse(flat, {0, -0.002}, {0.064, 0.067}), 0.003);
    colour = over(colour, hex(0x14120f), ellipse(flat, {-0.008, -0.002}, {0.034, 0.057}), 0.003);
    const dvec2 shine = point.z > 0 ? dvec2(0.018, 0.028) : dvec2(-0.028, 0.028); // both eyes alike
    colour = over(colour, hex(0xffffff), ellipse(flat, -0.8 * shine, {0.007, 0.007}), 0.002);
    return over(colour, hex(0xffffff), ellipse(flat, shine, {0.016, 0.017}), 0.002);
}

/// The mouth: a short line below the nose, an arc to either side, and the roots of the whiskers.
inline double mouth(dvec3 m) {
    const dvec2 face(m.z, m.y);
    const double line = std::max(m.z - 0.005, std::abs(m.y - 0.697) - 0.020);
    const double arc = std::max(std::abs(distance(face, dvec2(0.036, 0.684)) - 0.036) - 0.005, m.y - 0.680);
    const double roots = std::min({ellipse(face, {0.071, 0.715}, {0.006, 0.005}),
                                   ellipse(face, {0.077, 0.697}, {0.006, 0.005}),
                                   ellipse(face, {0.071, 0.679}, {0.006, 0.005})});
    return std::max(std::min({line, arc, roots}), 0.15 - m.x);
}

inline Colour hide(dvec3 point) {
    const dvec3 m = mirrored(point);
    Colour colour = mix(hex(0xf0a04b), hex(0xe38a35), glm::smoothstep(0.2, 0.9, point.y));
    colour = over(colour, stripe, coat_stripes(point), 0.006);
    colour = over(colour, cream, ellipsoid(m, {0.16, 0.42, 0}, {0.12, 0.19, 0.10}), 0.02); // chest
    colour = over(colour, cream, paws(m) - 0.014, 0.014);
    colour = over(colour, cream, muzzle(m) - 0.012, 0.012);
    colour = over(colour, cream, distance(point, tail_high.points[3]) - 0.10, 0.01); // tip of the tail
    colour = over(colour, pink, inner_ear(m), 0.004);
    colour = over(colour, hex(0x1f8a8c), collar_band(point), 0.003);
    colour = over(colour, hex(0xf2b93a), tag(point) - 0.006, 0.003);
    colour = over(colour, ink, mouth(m), 0.002);
    colour = over(colour, hex(0xe8858c), ellipsoid(m, nose_centre, nose_radii + 0.004), 0.003);
    return paint_eye(colour, point);
}

inline const Animal animal{"cat", {{-0.85, -0.1, -0.45}, {0.45, 1.2, 0.45}}, shape, hide, hex(0xe38a35)};

} // namespace rt::assets::cat
