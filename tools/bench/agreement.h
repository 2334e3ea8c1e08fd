// Do both sides find the same? Counts where they do not, by kind, and asks every triangle who is right.
#pragma once

#include "common/math/random.h"
#include "common/util/json.h"
#include "tools/bench/ours.h"

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace rt::bench {

/// Two distances along the same ray are the same if they differ by no more than this share.
inline constexpr float same_distance = 1e-4f;

struct Agreement {
    std::int64_t rays = 0;
    std::int64_t only_ours = 0, only_embree = 0;     ///< one of them meets something
    std::int64_t ours_nearer = 0, embree_nearer = 0; ///< both do, at other distances
    std::int64_t other_triangle = 0;                 ///< at the same distance: a shared edge, no disagreement
    std::int64_t judged = 0, ours_right = 0, embree_right = 0; ///< disagreements put to every triangle
    std::int64_t sampled = 0,
                 sampled_wrong = 0; ///< rays picked at random and put to every triangle; ours is wrong
};

inline std::int64_t disagreements(const Agreement& a) {
    return a.only_ours + a.only_embree + a.ours_nearer + a.embree_nearer;
}

inline bool same(const Found& a, const Found& b) {
    if (a.primitive == nothing || b.primitive == nothing) return a.primitive == b.primitive;
    return std::abs(a.t - b.t) <= same_distance * std::max(a.t, b.t);
}

/// Sorts one ray's pair of answers. `segment`: only whether something is met counts.
inline bool compare(Agreement& agreement, const Found& ours, const Found& embree, bool segment) {
    ++agreement.rays;
    if (ours.primitive == nothing && embree.primitive == nothing) return true;
    if (embree.primitive == nothing) return ++agreement.only_ours, false;
    if (ours.primitive == nothing) return ++agreement.only_embree, false;
    if (segment) return true;
    if (same(ours, embree)) {
        agreement.other_triangle += ours.primitive != embree.primitive;
        return true;
    }
    ++(ours.t < embree.t ? agreement.ours_nearer : agreement.embree_nearer);
    return false;
}

/// Is an answer the truth? For a segment, a hit anywhere is as good as the nearest.
inline bool right(const Found& answer, const Found& truth, bool segment) {
    if (segment) return (answer.primitive == nothing) == (truth.primitive == nothing);
    return same(answer, truth);
}

/// `embree` may be empty. Asks every triangle for at most `limit` disagreements and `limit` rays picked at
/// random.
inline Agreement compare(const Mesh& mesh, const std::vector<Ray>& rays, const std::vector<Found>& ours,
                         const std::vector<Found>& embree, bool segment, int limit) {
    Agreement agreement;
    agreement.rays = std::int64_t(embree.empty() ? rays.size() : 0);
    for (std::size_t i = 0; i < embree.size(); ++i) {
        if (compare(agreement, ours[i], embree[i], segment) || agreement.judged >= limit) continue;
        const Found truth = brute_nearest(mesh, rays[i]);
        ++agreement.judged;
        agreement.ours_right += right(ours[i], truth, segment);
        agreement.embree_right += right(embree[i], truth, segment);
    }
    Random random(3);
    for (int i = 0; i < limit && !rays.empty(); ++i) {
        const std::size_t pick = random.bits() % rays.size();
        ++agreement.sampled;
        agreement.sampled_wrong += !right(ours[pick], brute_nearest(mesh, rays[pick]), segment);
    }
    return agreement;
}

inline json::Fields fields(const Agreement& a) {
    return {{"rays", json::number(a.rays)},
            {"only_ours_hits", json::number(a.only_ours)},
            {"only_embree_hits", json::number(a.only_embree)},
            {"ours_nearer", json::number(a.ours_nearer)},
            {"embree_nearer", json::number(a.embree_nearer)},
            {"other_triangle_at_same_distance", json::number(a.other_triangle)},
            {"judged_by_brute_force", json::number(a.judged)},
            {"ours_right", json::number(a.ours_right)},
            {"embree_right", json::number(a.embree_right)},
            {"sampled_against_brute_force", json::number(a.sampled)},
            {"ours_wrong_among_sampled", json::number(a.sampled_wrong)}};
}

} // namespace rt::bench
