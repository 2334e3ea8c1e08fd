// Finds equal items: a chained hash table that numbers distinct ones.
#pragma once

#include "common/math/vec.h"

#include <bit>
#include <cstdint>
#include <vector>

namespace rt {

/// Assigns consecutive indices to distinct items: a chained hash table.
struct IndexMap {
    static constexpr std::uint32_t none = 0xffffffff;
    std::vector<std::uint32_t> heads; ///< by hash: the last thing numbered that has it,
    std::vector<std::uint32_t> next;  ///< by number: the one before it, and so on

    explicit IndexMap(std::size_t size) : heads(std::bit_ceil(size), none) {}

    /// `same(n)` returns whether item n equals this one. Equal items must have equal hashes.
    template <typename Same>
    std::uint32_t operator()(std::uint64_t hash, const Same& same) {
        std::uint32_t& head = heads[hash & (heads.size() - 1)];
        for (std::uint32_t n = head; n != none; n = next[n])
            if (same(n)) return n;
        next.push_back(head);
        return head = std::uint32_t(next.size() - 1);
    }
};

/// Returns a hash of the bits; 0 and -0 count as equal.
inline std::uint64_t hash_vec3(vec3 v) {
    std::uint64_t h = 0;
    for (int i = 0; i < 3; ++i) {
        h = (h ^ std::bit_cast<std::uint32_t>(v[i] + 0.0f)) * 0x9e3779b97f4a7c15; // -0 + 0 is 0, as -0 == 0
        h ^= h >> 32;
    }
    return h;
}

} // namespace rt
