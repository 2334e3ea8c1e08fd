// Do both sides find the same hits? Counts where they do not, by kind, and lets brute force say which side is
// right.
#pragma once

#include "common/math/random.h"
#include "common/util/json.h"
#include "tools/bench/ours.h"

#include <cmath>
#include <cstdint>
#include <vector>

namespace rt::bench {

/// Two distances along the same ray are the same if they differ by no more than this share.
inline constexpr float distance_tolerance = 1e-4f;

struct Agreement {
    std::int64_t rays = 0;
    std::int64_t only_ours = 0, only_embree = 0;     ///< only this side finds a hit
    std::int64_t ours_nearer = 0, embree_nearer = 0; ///< both do, at other distances
    std::int64_t other_triangle = 0;                 ///< at the same distance: a shared edge, no disagreement
    std::int64_t judged = 0, ours_right = 0, embree_right = 0; ///< disagreements that brute force has judged
    std::int64_t sampled = 0, sampled_wrong = 0; ///< random rays judged by brute force; ours is wrong
};

inline std::int64_t disagreements(const Agreement& a) {
    return a.only_ours + a.only_embree + a.ours_nearer + a.embree_nearer;
}

/// Of a shadow ray only counts whether there is a hit.
inline bool is_same(const ClosestHit& a, const ClosestHit& b, bool shadow) {
    if (shadow || a.primitive == no_primitive || b.primitive == no_primitive)
        return (a.primitive == no_primitive) == (b.primitive == no_primitive);
    return std::abs(a.t - b.t) <= distance_tolerance * std::max(a.t, b.t);
}

/// Counts the hits of one ray. Returns whether they are the same.
inline bool count(Agreement& agreement, const ClosestHit& ours, const ClosestHit& embree, bool shadow) {
    ++agreement.rays;
    if (is_same(ours, embree, shadow)) {
        agreement.other_triangle += !shadow && ours.primitive != embree.primitive;
        return true;
    }
    if (embree.primitive == no_primitive)
        ++agreement.only_ours;
    else if (ours.primitive == no_primitive)
        ++agreement.only_embree;
    else
        ++(ours.t < embree.t ? agreement.ours_nearer : agreement.embree_nearer);
    return false;
}

/// `embree` may be empty. Brute force judges at most `limit` disagreements, and `limit` random rays.
inline Agreement compare(const Mesh& mesh, const std::vector<Ray>& rays, const std::vector<ClosestHit>& ours,
                         const std::vector<ClosestHit>& embree, bool shadow, int limit) {
    Agreement agreement;
    agreement.rays = std::int64_t(embree.empty() ? rays.size() : 0);
    for (std::size_t i = 0; i < embree.size(); ++i) {
        if (count(agreement, ours[i], embree[i], shadow) || agreement.judged >= limit) continue;
        const ClosestHit truth = brute_force_closest_hit(mesh, rays[i]);
        ++agreement.judged;
        agreement.ours_right += is_same(ours[i], truth, shadow);
        agreement.embree_right += is_same(embree[i], truth, shadow);
    }
    Random random(3);
    for (int i = 0; i < limit && !rays.empty(); ++i) {
        const std::size_t pick = random.bits() % rays.size();
        ++agreement.sampled;
        agreement.sampled_wrong += !is_same(ours[pick], brute_force_closest_hit(mesh, rays[pick]), shadow);
    }
    return agreement;
}

inline Json json(const Agreement& a) {
    return {{"rays", a.rays},
            {"only_ours", a.only_ours},
            {"only_embree", a.only_embree},
            {"ours_nearer", a.ours_nearer},
            {"embree_nearer", a.embree_nearer},
            {"other_triangle", a.other_triangle},
            {"judged", a.judged},
            {"ours_right", a.ours_right},
            {"embree_right", a.embree_right},
            {"sampled", a.sampled},
            {"sampled_wrong", a.sampled_wrong}};
}

} // namespace rt::bench
