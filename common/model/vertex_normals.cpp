// Finds the faces around each vertex by hashing equal positions, and averages their normals.
#include "common/model/vertex_normals.h"

#include "common/model/index_map.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

namespace rt {

namespace {

/// Vertex adjacency: the corners of triangles (3 t + k for corner k of triangle t) at each vertex.
struct VertexCorners {
    std::vector<std::uint32_t> corner; ///< those of one point side by side, in ascending order
    std::vector<std::uint32_t> end;    ///< one a point: where its corners end and the next one's begin
};

/// Vertices with equal positions count as one, since many files repeat them for every face.
VertexCorners corners_by_vertex(const ObjModel& file) {
    IndexMap position_map(file.positions.size());
    std::vector<vec3> points;
    std::vector<std::uint32_t> point; // one per position
    for (const vec3 p : file.positions) {
        point.push_back(position_map(hash_vec3(p), [&](std::uint32_t n) { return points[n] == p; }));
        if (point.back() == points.size()) points.push_back(p);
    }
    const auto corner_count = std::uint32_t(3 * file.triangles.size());
    const auto point_of = [&](std::uint32_t c) {
        return point[std::size_t(file.triangles[c / 3][c % 3].position)];
    };
    VertexCorners corners{std::vector<std::uint32_t>(corner_count),
                          std::vector<std::uint32_t>(points.size() + 1)};
    for (std::uint32_t c = 0; c < corner_count; ++c) ++corners.end[point_of(c) + 1]; // how many,
    std::partial_sum(corners.end.begin(), corners.end.end(), corners.end.begin());   // where they begin,
    for (std::uint32_t c = 0; c < corner_count; ++c)
        corners.corner[corners.end[point_of(c)]++] = c; // and where they end
    corners.end.pop_back();
    return corners;
}

/// Splits the corners of each vertex by the smoothing groups of their triangles; in group 0 every corner is
/// on its own.
VertexCorners split_by_smoothing_group(VertexCorners corners, const std::vector<int>& groups) {
    if (groups.empty()) return corners;
    const auto group = [&](std::uint32_t i) { return groups[corners.corner[i] / 3]; };
    std::vector<std::uint32_t> end;
    for (std::uint32_t begin = 0; const std::uint32_t all : corners.end) {
        std::ranges::stable_sort(corners.corner.begin() + begin, corners.corner.begin() + all, {},
                                 [&](std::uint32_t corner) { return groups[corner / 3]; });
        for (std::uint32_t i = begin + 1; i <= all; ++i)
            if (i == all || group(i) == 0 || group(i) != group(i - 1)) end.push_back(i);
        begin = all;
    }
    corners.end = std::move(end);
    return corners;
}

/// For each face around a vertex, given by its area normal: the sum of the normals, its own included, that
/// differ from it by at most `crease_angle`, in radians.
std::vector<dvec3> smoothed_normals_at_vertex(const std::vector<dvec3>& faces, float crease_angle) {
    const dvec3 all = std::accumulate(faces.begin(), faces.end(), dvec3(0));
    const double min_dot_all = (std::cos(crease_angle / 2) + 1e-5) * length(all);
    const auto within_half_crease = [&](dvec3 face) { return dot(face, all) > min_dot_all * length(face); };
    // Every face is within crease / 2 of the sum, so no pair differs by more than crease.
    if (std::ranges::all_of(faces, within_half_crease)) return std::vector<dvec3>(faces.size(), all);

    std::vector<double> lengths;
    for (const dvec3 face : faces) lengths.push_back(length(face));
    std::vector<dvec3> sums(faces.size());
    for (std::size_t i = 0; i < faces.size(); ++i) {
        const double min_dot = std::cos(crease_angle) * lengths[i];
        dvec3 sum(0);
        for (std::size_t j = 0; j < faces.size(); ++j)
            if (dot(faces[i], faces[j]) >= min_dot * lengths[j]) sum += faces[j];
        sums[i] = sum;
    }
    return sums;
}

} // namespace

std::vector<std::array<vec3, 3>> smooth_normals(const ObjModel& file, float crease_angle) {
    const auto face = [&](std::uint32_t t) {
        const auto& [a, b, c] = file.triangles[t];
        return area_normal({file.positions[std::size_t(a.position)], file.positions[std::size_t(b.position)],
                            file.positions[std::size_t(c.position)]});
    };
    const VertexCorners corners = split_by_smoothing_group(corners_by_vertex(file), file.smoothing_groups);
    std::vector<std::array<vec3, 3>> normals(file.triangles.size());
    std::vector<dvec3> faces;
    for (std::uint32_t begin = 0; const std::uint32_t end : corners.end) {
        faces.clear();
        for (std::uint32_t i = begin; i < end; ++i) faces.push_back(face(corners.corner[i] / 3));
        const std::vector<dvec3> sums = smoothed_normals_at_vertex(faces, glm::radians(crease_angle));
        for (std::uint32_t i = begin; i < end; ++i) {
            const dvec3 sum = sums[i - begin];
            normals[corners.corner[i] / 3][corners.corner[i] % 3] =
                vec3(normalize(length(sum) > 0 ? sum : faces[i - begin]));
        }
        begin = end;
    }
    return normals;
}

} // namespace rt
