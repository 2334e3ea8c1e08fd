// Do two sides find the same hits? Counts where they do not, by kind; brute force says which is correct.
#pragma once

#include "accel/bench/scenes.h"
#include "common/util/json.h"

#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

namespace rt::bench {

using Hits = std::vector<std::optional<accel::Hit>>; ///< one per ray

/// Tests every triangle in double (Moller and Trumbore 1997), which shares no code with the tree.
inline std::optional<accel::Hit> brute_force_closest_hit(const accel::TriangleMesh& mesh, accel::Ray ray) {
    const dvec3 direction(ray.direction);
    const double outside = -0x1p-40; // rounding may not open an edge
    std::optional<accel::Hit> closest;
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
        const auto [a, b, c] = triangle_at(mesh, i);
        const dvec3 edge_b = dvec3(b) - dvec3(a), edge_c = dvec3(c) - dvec3(a);
        const dvec3 from_a = dvec3(ray.origin) - dvec3(a);
        const dvec3 p = cross(direction, edge_c), q = cross(from_a, edge_b);
        const double inverse = 1 / dot(edge_b, p);
        const double u = inverse * dot(from_a, p), v = inverse * dot(direction, q);
        const auto t = float(inverse * dot(edge_c, q));
        if (!(u >= outside && v >= outside && 1 - u - v >= outside && in_interval(ray, t))) continue;
        ray.t_max = t;
        closest = accel::Hit{t, float(u), float(v), i};
    }
    return closest;
}

/// Returns whether both hit, or neither; and unless it is a shadow ray, whether the distances agree to 1e-4.
inline bool is_same(const std::optional<accel::Hit>& a, const std::optional<accel::Hit>& b, bool shadow) {
    if (shadow || !a || !b) return a.has_value() == b.has_value();
    return std::abs(a->t - b->t) <= 1e-4f * std::max(a->t, b->t);
}

/// Counts of rays, by name. only_...: only this side finds a hit; ..._nearer: both do, at other distances;
/// other_triangle: at the same distance, as on a shared edge, which is no disagreement; judged: disagreements
/// that brute force has judged; sampled: random rays that it has judged.
using Agreement = nlohmann::ordered_map<std::string, std::int64_t>;

inline const char* kind_of_disagreement(const std::optional<accel::Hit>& ours,
                                        const std::optional<accel::Hit>& embree) {
    if (!embree) return "only_ours";
    if (!ours) return "only_embree";
    return ours->t < embree->t ? "ours_nearer" : "embree_nearer";
}

/// Compares the hits of two sides; those of Embree may be empty. Brute force judges at most `limit`
/// disagreements, and as many random rays. Of a shadow ray only counts whether it hits.
inline Agreement compare(const accel::TriangleMesh& mesh, const std::vector<accel::Ray>& rays,
                         const Hits& ours, const Hits& embree, bool shadow, int limit) {
    Agreement counts;
    for (const char* name :
         {"rays", "only_ours", "only_embree", "ours_nearer", "embree_nearer", "other_triangle", "judged",
          "ours_right", "embree_right", "sampled", "sampled_wrong"})
        counts[name] = 0;
    counts["rays"] = std::int64_t(rays.size());
    for (std::size_t i = 0; i < embree.size(); ++i) {
        if (is_same(ours[i], embree[i], shadow)) {
            counts["other_triangle"] += !shadow && ours[i] && ours[i]->primitive != embree[i]->primitive;
            continue;
        }
        ++counts[kind_of_disagreement(ours[i], embree[i])];
        if (counts["judged"] >= limit) continue;
        const auto truth = brute_force_closest_hit(mesh, rays[i]);
        ++counts["judged"];
        counts["ours_right"] += is_same(ours[i], truth, shadow);
        counts["embree_right"] += is_same(embree[i], truth, shadow);
    }
    Random random(3);
    for (; counts["sampled"] < limit && !rays.empty(); ++counts["sampled"]) {
        const std::size_t pick = random.bits() % rays.size();
        counts["sampled_wrong"] += !is_same(ours[pick], brute_force_closest_hit(mesh, rays[pick]), shadow);
    }
    return counts;
}

} // namespace rt::bench
