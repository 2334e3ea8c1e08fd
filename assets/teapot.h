// The Utah teapot at any density: 32 bicubic Bezier patches, described as rings and tubes.
//
// Martin Newell's control points of 1975 (University of Utah). He drew the outline of body, lid and
// bottom and rotated it by quarter turns; handle and spout are tubes, mirrored left and right. So the
// 306 published points follow from the few numbers below. Newell's z is up and the pot is 3.15 high.
// Here y is up, the bottom is at y = 0, the spout points to +x, and one unit is the radius of the belly:
// half the size, 1.575 high.
#pragma once

#include "assets/mesh.h"

#include <algorithm>
#include <array>
#include <vector>

namespace rt::assets {

/// A point of a rotated profile. A cubic quarter circle from (r, 0) to (0, r) has its inner control
/// points at (r, s) and (s, r). Newell uses s = 0.56 r (0.5523 r is closest to a circle), but 0.45 r in
/// the wide row of the knob.
struct RingRow {
    double radius, shoulder, height;
};

/// A ring of four rows from top to bottom; the texture's v goes from `v_top` to `v_bottom`.
struct Ring {
    double v_top, v_bottom;
    std::array<RingRow, 4> rows;
};

/// A cross section of a tube: it meets the mirror plane in two points (x, height) and is
/// 2 * `half_width` wide.
struct PotTubeRow {
    double half_width;
    dvec2 inner, outer;
};

struct PotTube {
    double u_begin, u_end; ///< the texture's u runs along the tube, v around it
    std::array<PotTubeRow, 4> rows;
};

// clang-format off
inline constexpr std::array<Ring, 6> teapot_rings{{
    // rim, belly, foot
    {1, 0.95,   {{{1.4, 0.784, 2.4}, {1.3375, 0.749, 2.53125}, {1.4375, 0.805, 2.53125}, {1.5, 0.84, 2.4}}}},
    {0.95, 0.4, {{{1.5, 0.84, 2.4}, {1.75, 0.98, 1.875}, {2, 1.12, 1.35}, {2, 1.12, 0.9}}}},
    {0.4, 0,    {{{2, 1.12, 0.9}, {2, 1.12, 0.45}, {1.5, 0.84, 0.225}, {1.5, 0.84, 0.15}}}},
    // knob, lid
    {1, 0.6,    {{{0, 0, 3.15}, {0.8, 0.45, 3.15}, {0, 0, 2.85}, {0.2, 0.112, 2.7}}}},
    {0.6, 0,    {{{0.2, 0.112, 2.7}, {0.4, 0.224, 2.55}, {1.3, 0.728, 2.55}, {1.3, 0.728, 2.4}}}},
    // bottom
    {1, 0,      {{{1.5, 0.84, 0.15}, {1.5, 0.84, 0.075}, {1.425, 0.798, 0}, {0, 0, 0}}}},
}};

inline constexpr std::array<PotTube, 4> teapot_tubes{{
    // handle, from the rim down
    {0, 0.5, {{{0.3, {-1.6, 2.025}, {-1.5, 2.25}},  {0.3, {-2.3, 2.025}, {-2.5, 2.25}},
               {0.3, {-2.7, 2.025}, {-3, 2.25}},    {0.3, {-2.7, 1.8}, {-3, 1.8}}}}},
    {0.5, 1, {{{0.3, {-2.7, 1.8}, {-3, 1.8}},       {0.3, {-2.7, 1.575}, {-3, 1.35}},
               {0.3, {-2.5, 1.125}, {-2.65, 0.9375}}, {0.3, {-2, 0.9}, {-1.9, 0.6}}}}},
    // spout, from the belly out; its last rows bend back inside the mouth
    {0, 0.7, {{{0.66, {1.7, 1.425}, {1.7, 0.6}},    {0.66, {2.6, 1.425}, {3.1, 0.825}},
               {0.25, {2.3, 2.1}, {2.4, 2.025}},    {0.25, {2.7, 2.4}, {3.3, 2.4}}}}},
    {0.7, 1, {{{0.25, {2.7, 2.4}, {3.3, 2.4}},      {0.25, {2.8, 2.475}, {3.525, 2.49375}},
               {0.15, {2.9, 2.475}, {3.45, 2.5125}}, {0.15, {2.8, 2.4}, {3.2, 2.4}}}}},
}};
// clang-format on

/// A patch. Rows run along s, the points of a row along t, and s cross t is outward. The texture coordinates
/// are linear: uv = uv_corner + s uv_along_s + t uv_along_t.
struct Patch {
    std::array<std::array<dvec3, 4>, 4> points;
    dvec2 uv_corner, uv_along_s, uv_along_t;
};

/// Converts Newell's (x, y, z), z up, to ours, y up, at half the size. It is a rotation,
/// so left and right stay.
inline dvec3 from_newell(double x, double y, double z) {
    return 0.5 * dvec3(x, z, -y);
}

/// Returns the quarter of a ring that starts `quarter` right angles from -x,
/// counter-clockwise seen from above.
inline Patch ring_patch(const Ring& ring, int quarter) {
    Patch patch{{}, {quarter / 4.0, ring.v_top}, {0, ring.v_bottom - ring.v_top}, {0.25, 0}};
    for (int row = 0; row < 4; ++row) {
        const auto [radius, shoulder, height] = ring.rows[row];
        std::array<dvec2, 4> arc{{{-radius, 0}, {-radius, -shoulder}, {-shoulder, -radius}, {0, -radius}}};
        for (int column = 0; column < 4; ++column) {
            for (int turn = 0; turn < quarter; ++turn) arc[column] = {-arc[column].y, arc[column].x};
            patch.points[row][column] = from_newell(arc[column].x, arc[column].y, height);
        }
    }
    return patch;
}

/// Returns half of a tube: side 0 runs from the inner line over +y to the outer line,
/// side 1 over -y back again.
inline Patch tube_patch(const PotTube& tube, int side) {
    Patch patch{{}, {tube.u_begin, side / 2.0}, {tube.u_end - tube.u_begin, 0}, {0, 0.5}};
    for (int row = 0; row < 4; ++row) {
        const auto [half_width, inner, outer] = tube.rows[row];
        const dvec2 from = side == 0 ? inner : outer;
        const dvec2 to = side == 0 ? outer : inner;
        const double y = side == 0 ? half_width : -half_width;
        patch.points[row] = {from_newell(from.x, 0, from.y), from_newell(from.x, y, from.y),
                             from_newell(to.x, y, to.y), from_newell(to.x, 0, to.y)};
    }
    return patch;
}

inline std::vector<Patch> teapot_patches() {
    std::vector<Patch> patches;
    for (const Ring& ring : teapot_rings)
        for (int quarter = 0; quarter < 4; ++quarter) patches.push_back(ring_patch(ring, quarter));
    for (const PotTube& tube : teapot_tubes)
        for (int side = 0; side < 2; ++side) patches.push_back(tube_patch(tube, side));
    return patches;
}

/// Returns the cubic Bernstein polynomials. At t = 0 and t = 1 they are exactly 0 and 1, so that two patches
/// with a common edge get identical points there.
inline std::array<double, 4> bernstein(double t) {
    const double r = 1 - t;
    return {r * r * r, 3 * r * r * t, 3 * r * t * t, t * t * t};
}

inline std::array<double, 4> bernstein_slope(double t) {
    const double r = 1 - t;
    return {-3 * r * r, 3 * r * (r - 2 * t), 3 * t * (2 * r - t), 3 * t * t};
}

inline dvec3 weighted_sum(const Patch& patch, const std::array<double, 4>& rows,
                          const std::array<double, 4>& columns) {
    dvec3 sum(0);
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 4; ++column)
            sum += rows[row] * columns[column] * patch.points[row][column];
    return sum;
}

inline dvec3 patch_position(const Patch& patch, double s, double t) {
    return weighted_sum(patch, bernstein(s), bernstein(t));
}

/// Returns the outward normal. Where a row has shrunk to a point (the poles of lid and bottom), the
/// derivative along it vanishes, and the normal is taken slightly further inside.
inline dvec3 patch_normal(const Patch& patch, double s, double t) {
    const dvec3 along_s = weighted_sum(patch, bernstein_slope(s), bernstein(t));
    const dvec3 along_t = weighted_sum(patch, bernstein(s), bernstein_slope(t));
    const dvec3 outward = cross(along_s, along_t);
    if (length(outward) < 1e-9) return patch_normal(patch, std::clamp(s, 1e-6, 1 - 1e-6), t);
    return normalize(outward);
}

/// Adds the triangle unless two of its vertices coincide: at a pole, quads become triangles.
inline void add_unless_flat(Mesh& mesh, const std::array<int, 3>& corners) {
    const auto apart = [&](int i, int j) {
        return distance(mesh.positions[corners[i]], mesh.positions[corners[j]]) > 1e-9;
    };
    if (apart(0, 1) && apart(1, 2) && apart(2, 0)) mesh.triangles.push_back({corners, corners});
}

/// Returns a grid of `density` x `density` quads, two triangles each.
inline Mesh tessellate(const Patch& patch, int density) {
    Mesh mesh;
    for (int i = 0; i <= density; ++i)
        for (int j = 0; j <= density; ++j) {
            const double s = double(i) / density;
            const double t = double(j) / density;
            mesh.positions.push_back(patch_position(patch, s, t));
            mesh.normals.push_back(patch_normal(patch, s, t));
            mesh.uvs.push_back(patch.uv_corner + s * patch.uv_along_s + t * patch.uv_along_t);
        }
    for (int i = 0; i < density; ++i)
        for (int j = 0; j < density; ++j) {
            const int corner = i * (density + 1) + j;
            const int below = corner + density + 1;
            add_unless_flat(mesh, {corner, below, below + 1});
            add_unless_flat(mesh, {corner, below + 1, corner + 1});
        }
    return mesh;
}

} // namespace rt::assets
