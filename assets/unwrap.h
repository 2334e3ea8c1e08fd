// Makes a texture atlas for any closed mesh: cuts it where its dominant axis changes, flattens, packs.
#pragma once

#include "assets/mesh.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace rt::assets {

/// Returns one of six view directions: 0..2 are +x, +y, +z, 3..5 are -x, -y, -z.
inline dvec3 side_normal(int side) {
    dvec3 normal(0);
    normal[side % 3] = side < 3 ? 1 : -1;
    return normal;
}

/// Projects a point as seen from that side, to right and up in the image plane, so that nothing is mirrored.
inline dvec2 seen_from(int side, dvec3 point) {
    const dvec3 up = side % 3 == 1 ? dvec3(1, 0, 0) : dvec3(0, 1, 0);
    return {dot(point, cross(up, side_normal(side))), dot(point, up)};
}

/// Returns the neighbours of each triangle: neighbours[t][k] is across the edge from
/// vertex k to vertex k + 1.
inline std::vector<std::array<int, 3>> find_neighbours(const Mesh& mesh) {
    std::map<std::pair<int, int>, int> triangle_of_edge;
    const auto edge = [&](std::size_t t, int k) {
        return std::pair(mesh.triangles[t].vertex[k], mesh.triangles[t].vertex[(k + 1) % 3]);
    };
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for (int k = 0; k < 3; ++k) triangle_of_edge[edge(t, k)] = int(t);
    std::vector<std::array<int, 3>> neighbours(mesh.triangles.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for (int k = 0; k < 3; ++k)
            neighbours[t][k] = triangle_of_edge.at({edge(t, k).second, edge(t, k).first});
    return neighbours;
}

/// Returns the side that each triangle faces most. A triangle then follows a majority of its neighbours if it
/// still faces that side well enough: fewer small charts, straighter seams.
inline std::vector<int> choose_sides(const Mesh& mesh, const std::vector<std::array<int, 3>>& neighbours) {
    std::vector<dvec3> facing;
    std::vector<int> sides;
    for (const Triangle& triangle : mesh.triangles) {
        facing.push_back(normalize(area_vector(mesh, triangle)));
        int best = 0;
        for (int side = 1; side < 6; ++side)
            if (dot(facing.back(), side_normal(side)) > dot(facing.back(), side_normal(best))) best = side;
        sides.push_back(best);
    }
    for (int pass = 0; pass < 8; ++pass)
        for (std::size_t t = 0; t < sides.size(); ++t)
            for (int k = 0; k < 3; ++k) {
                const int side = sides[neighbours[t][k]];
                const bool majority = side == sides[neighbours[t][(k + 1) % 3]];
                if (majority && dot(facing[t], side_normal(side)) > 0.5) sides[t] = side;
            }
    return sides;
}

/// A connected piece of the surface that faces one side, and its rectangle in the plane.
struct Chart {
    int side = 0;
    std::vector<int> triangles;
    dvec2 low{1e9}, high{-1e9}; ///< in the mesh's unit of length
    ivec2 place{0};             ///< the rectangle's lower left texel in the atlas
};

inline std::vector<Chart> cut_into_charts(const Mesh& mesh) {
    const auto neighbours = find_neighbours(mesh);
    const std::vector<int> sides = choose_sides(mesh, neighbours);
    std::vector<bool> taken(sides.size(), false);
    std::vector<Chart> charts;
    for (std::size_t seed = 0; seed < sides.size(); ++seed) {
        if (taken[seed]) continue;
        Chart chart{sides[seed], {int(seed)}};
        taken[seed] = true;
        for (std::size_t next = 0; next < chart.triangles.size(); ++next) {
            const int t = chart.triangles[next];
            for (const int vertex : mesh.triangles[t].vertex) {
                chart.low = min(chart.low, seen_from(chart.side, mesh.positions[vertex]));
                chart.high = max(chart.high, seen_from(chart.side, mesh.positions[vertex]));
            }
            for (const int neighbour : neighbours[t])
                if (!taken[neighbour] && sides[neighbour] == chart.side) {
                    taken[neighbour] = true;
                    chart.triangles.push_back(neighbour);
                }
        }
        charts.push_back(chart);
    }
    return charts;
}

inline constexpr int atlas_padding = 3; ///< texels around a chart, so that neighbours do not bleed into it

/// Packs the charts on shelves, tallest first, at `scale` texels per unit. Returns false if they do not fit.
inline bool pack(std::vector<Chart>& charts, double scale, int atlas_size) {
    ivec2 pen(0);
    int shelf_height = 0;
    for (Chart& chart : charts) {
        const ivec2 size = ivec2(glm::ceil((chart.high - chart.low) * scale)) + 2 * atlas_padding;
        if (pen.x + size.x > atlas_size) {
            pen = {0, pen.y + shelf_height};
            shelf_height = 0;
        }
        if (pen.x + size.x > atlas_size || pen.y + size.y > atlas_size) return false;
        chart.place = pen;
        pen.x += size.x;
        shelf_height = std::max(shelf_height, size.y);
    }
    return true;
}

/// Computes the uvs, at the largest scale found at which the charts fit into
/// `atlas_size` x `atlas_size` texels.
inline void unwrap(Mesh& mesh, int atlas_size) {
    std::vector<Chart> charts = cut_into_charts(mesh);
    std::stable_sort(charts.begin(), charts.end(),
                     [](const Chart& a, const Chart& b) { return a.high.y - a.low.y > b.high.y - b.low.y; });
    double scale = 2.0 * atlas_size;
    while (!pack(charts, scale, atlas_size)) scale *= 0.995;
    for (const Chart& chart : charts) {
        std::map<int, int> uv_of_vertex;
        for (const int t : chart.triangles)
            for (int k = 0; k < 3; ++k) {
                const int vertex = mesh.triangles[t].vertex[k];
                const auto [entry, is_new] = uv_of_vertex.try_emplace(vertex, int(mesh.uvs.size()));
                mesh.triangles[t].uv[k] = entry->second;
                if (!is_new) continue;
                const dvec2 inside = (seen_from(chart.side, mesh.positions[vertex]) - chart.low) * scale;
                mesh.uvs.push_back((dvec2(chart.place + atlas_padding) + inside) / double(atlas_size));
            }
    }
}

} // namespace rt::assets
