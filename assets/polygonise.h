// Surface nets: turns a signed distance into a closed triangle mesh of about the requested size.
// Gibson 1998, "Constrained Elastic Surface Nets": a vertex in every grid cell that the surface
// crosses, and a quad across every grid edge that it cuts. Where two sheets of the surface cross a
// cell, each has its own vertex.
#pragma once

#include "assets/implicit.h"

#include <map>
#include <numeric>
#include <utility>

namespace rt::assets {

struct Box {
    dvec3 low, high;
};

/// Calls `visit` for the grid points from `first` to `last`, exclusive.
template <class Visit>
void for_each_point(ivec3 first, ivec3 last, const Visit& visit) {
    for (int z = first.z; z < last.z; ++z)
        for (int y = first.y; y < last.y; ++y)
            for (int x = first.x; x < last.x; ++x) visit(ivec3(x, y, z));
}

/// The signed distance sampled at the corners of a grid of cubic cells. The origin is a corner, so that a
/// symmetric shape gets a symmetric mesh.
class SampledGrid {
  public:
    SampledGrid(const Distance& shape, const Box& box, double cell_size)
        : cell(cell_size), low(glm::floor(box.low / cell)),
          size(ivec3(glm::ceil(box.high / cell)) - low + 1) {
        for_each_point(ivec3(0), size, [&](ivec3 at) { values.push_back(shape(corner(at))); });
    }

    ivec3 corner_count() const { return size; }
    dvec3 corner(ivec3 at) const { return cell * dvec3(low + at); }
    std::size_t index(ivec3 at) const {
        return (std::size_t(at.z) * std::size_t(size.y) + std::size_t(at.y)) * std::size_t(size.x) +
               std::size_t(at.x);
    }
    double operator()(ivec3 at) const { return values[index(at)]; }

  private:
    double cell;
    ivec3 low; ///< the first corner, in cells from the origin
    ivec3 size;
    std::vector<double> values;
};

inline const std::array<ivec3, 3> axes{ivec3(1, 0, 0), ivec3(0, 1, 0), ivec3(0, 0, 1)};

/// Returns the index of one of the twelve edges of a cell: 4 * axis + its position across that axis. Corners
/// are 0 or 1 along x, y, z.
inline int edge_index(ivec3 from, ivec3 to) {
    const int axis = from.x != to.x ? 0 : from.y != to.y ? 1 : 2;
    return 4 * axis + from[(axis + 1) % 3] + 2 * from[(axis + 2) % 3];
}

/// Returns whether some of the cell's corners are inside and some outside.
inline bool is_crossed(const SampledGrid& grid, ivec3 cell) {
    int inside = 0;
    for (int corner = 0; corner < 8; ++corner)
        inside += grid(cell + ivec3(corner & 1, corner >> 1 & 1, corner >> 2)) < 0;
    return inside != 0 && inside != 8;
}

using EdgeLabels = std::array<int, 12>; ///< one number per edge of a cell

/// Gives the cut edges of the same sheet the same label. On each face of the cell, the outline of the
/// surface enters at one cut edge and leaves at the next, around corners that are inside; both cells at the
/// face see it the same way.
inline EdgeLabels label_sheets(const SampledGrid& grid, ivec3 cell) {
    EdgeLabels sheet;
    std::iota(sheet.begin(), sheet.end(), 0);
    for (int face = 0; face < 6; ++face) {
        const ivec3 origin = (face / 3) * axes[face % 3], a = axes[(face + 1) % 3], b = axes[(face + 2) % 3];
        const std::array<ivec3, 4> around{origin, origin + a, origin + a + b, origin + b};
        const auto corner = [&](int i) { return around[std::size_t(i % 4)]; };
        const auto inside = [&](int i) { return grid(cell + corner(i)) < 0; };
        for (int enter = 0; enter < 4; ++enter) {
            if (inside(enter) || !inside(enter + 1)) continue;
            int leave = enter + 1;
            while (inside(leave + 1)) ++leave;
            const int old_label = sheet[edge_index(corner(leave), corner(leave + 1))];
            const int new_label = sheet[edge_index(corner(enter), corner(enter + 1))];
            std::replace(sheet.begin(), sheet.end(), old_label, new_label);
        }
    }
    return sheet;
}

using Quad = std::array<int, 4>;

struct QuadMesh {
    std::vector<dvec3> positions;
    std::vector<Quad> quads; ///< counter-clockwise seen from outside
};

/// Adds a vertex for each sheet in the cell, the mean of the points where the sheet cuts edges. Returns the
/// vertex of each edge, -1 for edges that are not cut.
inline EdgeLabels add_cell_vertices(QuadMesh& net, const SampledGrid& grid, ivec3 cell) {
    const EdgeLabels sheet = label_sheets(grid, cell);
    std::array<dvec3, 12> sums{};
    std::array<int, 12> counts{};
    EdgeLabels vertex;
    vertex.fill(-1);
    for (int edge = 0; edge < 12; ++edge) {
        const int axis = edge / 4;
        const ivec3 from = cell + (edge & 1) * axes[(axis + 1) % 3] + (edge >> 1 & 1) * axes[(axis + 2) % 3];
        const ivec3 to = from + axes[axis];
        if ((grid(from) < 0) == (grid(to) < 0)) continue;
        sums[sheet[edge]] += mix(grid.corner(from), grid.corner(to), grid(from) / (grid(from) - grid(to)));
        ++counts[sheet[edge]];
        vertex[edge] = sheet[edge];
    }
    for (int label = 0; label < 12; ++label) {
        if (counts[label] == 0) continue;
        for (int edge = 0; edge < 12; ++edge)
            if (vertex[edge] >= 0 && sheet[edge] == label) vertex[edge] = int(net.positions.size());
        net.positions.push_back(sums[label] / double(counts[label]));
    }
    return vertex;
}

inline QuadMesh surface_net(const SampledGrid& grid) {
    QuadMesh net;
    std::map<std::size_t, EdgeLabels> vertices_of_cell;
    for_each_point(ivec3(0), grid.corner_count() - 1, [&](ivec3 cell) {
        if (is_crossed(grid, cell)) vertices_of_cell[grid.index(cell)] = add_cell_vertices(net, grid, cell);
    });
    for_each_point(ivec3(1), grid.corner_count() - 1, [&](ivec3 from) {
        for (int axis = 0; axis < 3; ++axis) {
            const bool from_inside = grid(from) < 0, to_inside = grid(from + axes[axis]) < 0;
            if (from_inside == to_inside) continue;
            // Returns the vertex of the cell that is a and b steps back across the edge.
            const auto vertex = [&](int a, int b) {
                const ivec3 cell = from - a * axes[(axis + 1) % 3] - b * axes[(axis + 2) % 3];
                return vertices_of_cell.at(grid.index(cell))[4 * axis + a + 2 * b];
            };
            if (from_inside)
                net.quads.push_back({vertex(1, 1), vertex(0, 1), vertex(0, 0), vertex(1, 0)});
            else
                net.quads.push_back({vertex(1, 1), vertex(1, 0), vertex(0, 0), vertex(0, 1)});
        }
    });
    return net;
}

/// Evens out the quads: moves each vertex along the surface towards the mean of its neighbours.
inline void relax(QuadMesh& net, const Distance& shape, double cell) {
    for (int pass = 0; pass < 8; ++pass) {
        std::vector<dvec3> sums(net.positions.size(), dvec3(0));
        std::vector<int> counts(net.positions.size(), 0);
        for (const Quad& quad : net.quads)
            for (int i = 0; i < 4; ++i) {
                sums[quad[i]] += net.positions[quad[(i + 1) % 4]] + net.positions[quad[(i + 3) % 4]];
                counts[quad[i]] += 2;
            }
        for (std::size_t i = 0; i < net.positions.size(); ++i) {
            const dvec3 position = net.positions[i];
            const dvec3 normal = normalize(gradient(shape, position, cell / 2));
            const dvec3 toward_mean = sums[i] / double(counts[i]) - position;
            const dvec3 slide = toward_mean - dot(toward_mean, normal) * normal;
            net.positions[i] = project_to_surface(shape, position + 0.5 * slide);
        }
    }
}

/// Splits quads along the shorter diagonal. A normal is the area-weighted mean over the triangles around its
/// vertex: smooth, and never far from the triangles that it shades. There are no uvs yet.
inline Mesh triangulate(const QuadMesh& net) {
    Mesh mesh;
    mesh.positions = net.positions;
    for (const auto& [a, b, c, d] : net.quads) {
        const auto apart = [&](int i, int j) { return distance(mesh.positions[i], mesh.positions[j]); };
        const bool cut_a_to_c = apart(a, c) < apart(b, d);
        mesh.triangles.push_back(cut_a_to_c ? Triangle{{a, b, c}, {}} : Triangle{{a, b, d}, {}});
        mesh.triangles.push_back(cut_a_to_c ? Triangle{{a, c, d}, {}} : Triangle{{b, c, d}, {}});
    }
    mesh.normals.assign(mesh.positions.size(), dvec3(0));
    for (const Triangle& triangle : mesh.triangles)
        for (const int vertex : triangle.vertex) mesh.normals[vertex] += area_vector(mesh, triangle);
    for (dvec3& normal : mesh.normals) normal = normalize(normal);
    return mesh;
}

/// Returns whether every edge is shared by exactly two quads, which run along it in opposite directions.
inline bool is_closed(const QuadMesh& net) {
    std::map<std::pair<int, int>, int> uses;
    for (const Quad& quad : net.quads)
        for (int i = 0; i < 4; ++i) ++uses[{quad[i], quad[(i + 1) % 4]}];
    return std::all_of(uses.begin(), uses.end(), [&](const auto& use) {
        const auto opposite = uses.find({use.first.second, use.first.first});
        return use.second == 1 && opposite != uses.end() && opposite->second == 1;
    });
}

/// Returns a closed mesh of about the requested number of triangles. Their number is proportional to 1 /
/// cell^2, so two trials find the cell size. Where the grid is too coarse for a narrow gap, the net may touch
/// itself along an edge; a slightly finer grid then helps.
inline Mesh polygonise(const Distance& shape, const Box& box, int triangles) {
    double cell = 0.05;
    for (int trial = 0; trial < 2; ++trial) {
        const QuadMesh net = surface_net(SampledGrid(shape, box, cell));
        cell *= std::sqrt(2.0 * double(net.quads.size()) / triangles);
    }
    QuadMesh net = surface_net(SampledGrid(shape, box, cell));
    while (!is_closed(net)) {
        cell *= 0.98;
        net = surface_net(SampledGrid(shape, box, cell));
    }
    relax(net, shape, cell);
    return triangulate(net);
}

} // namespace rt::assets
