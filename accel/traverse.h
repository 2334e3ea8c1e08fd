// How a ray finds its closest hit in a wide tree, or whether it hits anything at all.
#pragma once

#include "accel/wide_bvh.h"

#include <array>
#include <cstdint>
#include <utility>

namespace rt::accel {

/// Counts nothing, and costs nothing. A search counts what it tests by another type with these two functions.
struct NoCounters {
    static void count_boxes(std::size_t) {}
    static void count_primitives(std::size_t) {}
};

/// A child that the ray enters and has not visited yet.
struct StackEntry {
    std::uint32_t child;
    float t;
};

/// Pushes the entry below those from `begin` on that are nearer.
inline void push_sorted(const StackEntry* begin, StackEntry*& top, StackEntry entry) {
    StackEntry* slot = top++;
    for (; slot > begin && slot[-1].t < entry.t; --slot) *slot = slot[-1];
    *slot = entry;
}

/// Descends from `child` to a leaf, always into the nearest box, and pushes the others that the ray enters.
/// Returns false if it reaches a node of which the ray enters none.
template <typename Counters, typename Block>
[[gnu::always_inline]] inline bool descend(const WideBvh<Block>& bvh, const WideRay& ray, FloatN t_max,
                                           StackEntry*& top, std::uint32_t& child) {
    while (!is_leaf(child)) {
        const WideNode& node = node_at(bvh, child);
        Counters::count_boxes(simd_width);
        FloatN t_near;
        unsigned hit_mask = intersect_children(node, ray, t_max, t_near);
        if (hit_mask == 0) return false;
        const std::size_t first = pop_lowest_bit(hit_mask);
        child = node.children[first];
        if (hit_mask == 0) continue;
        prefetch(bvh, child);
        alignas(FloatN) float t[simd_width];
        __builtin_memcpy(t, &t_near, sizeof t);
        StackEntry nearest{child, t[first]};
        for (const StackEntry* const begin = top; hit_mask != 0;) {
            const std::size_t lane = pop_lowest_bit(hit_mask);
            StackEntry entry{node.children[lane], t[lane]};
            prefetch(bvh, entry.child);
            if (entry.t < nearest.t) std::swap(entry, nearest);
            push_sorted(begin, top, entry);
        }
        child = nearest.child;
    }
    return true;
}

/// Calls test(block, lane) for the primitives that the ray may hit, nearest boxes first. test() finds the
/// exact hit, if there is one, and sets the t_max of `ray` to it; boxes beyond are then skipped.
template <typename Counters = NoCounters, typename Block, RayLike AnyRay, typename Test>
void closest_hit(const WideBvh<Block>& bvh, const AnyRay& ray, Test&& test) {
    if (bvh.storage.empty()) return;
    const WideRay wide = wide_ray(ray);
    const auto leaf_ray = Block::make_ray(ray);
    // A function of its own, so that it does not take registers from the traversal.
    const auto test_all = [&](const Block& block, unsigned maybe) __attribute__((noinline)) {
        while (maybe != 0) test(block, pop_lowest_bit(maybe));
    };
    std::array<StackEntry, (simd_width - 1) * max_depth> stack; // a node pushes all children but one
    StackEntry* top = stack.data();
    std::uint32_t child = bvh.root;
    while (true) {
        if (descend<Counters>(bvh, wide, broadcast(ray.t_max), top, child)) {
            const Block& block = leaf_at(bvh, child);
            Counters::count_primitives(simd_width);
            if (const unsigned maybe = candidates(block, leaf_ray, ray.t_min, ray.t_max).maybe; maybe != 0)
                test_all(block, maybe);
        }
        do {
            if (top == stack.data()) return;
            --top;
        } while (top->t > ray.t_max);
        child = top->child;
    }
}

/// Returns whether the ray hits any primitive; test(block, lane) decides where the block is not certain.
/// The order of the children does not matter here, so the stack holds a node and the mask of its
/// children that are left.
template <typename Counters = NoCounters, typename Block, RayLike AnyRay, typename Test>
bool any_hit(const WideBvh<Block>& bvh, const AnyRay& ray, Test&& test) {
    struct MaskEntry {
        const WideNode* node;
        unsigned hit_mask;
    };
    if (bvh.storage.empty()) return false;
    const WideRay wide = wide_ray(ray);
    const auto leaf_ray = Block::make_ray(ray);
    // As above.
    const auto test_any = [&](const Block& block, unsigned maybe) __attribute__((noinline)) {
        while (maybe != 0)
            if (test(block, pop_lowest_bit(maybe))) return true;
        return false;
    };
    const FloatN t_max = broadcast(ray.t_max);
    std::array<MaskEntry, max_depth> stack;
    MaskEntry* top = stack.data();
    std::uint32_t child = bvh.root;
    while (true) {
        if (is_leaf(child)) {
            const Block& block = leaf_at(bvh, child);
            Counters::count_primitives(simd_width);
            const Candidates found = candidates(block, leaf_ray, ray.t_min, ray.t_max);
            if (found.certain != 0) return true;
            if (found.maybe != 0 && test_any(block, found.maybe)) return true;
        } else {
            Counters::count_boxes(simd_width);
            FloatN t_near;
            const WideNode& node = node_at(bvh, child);
            if (unsigned hit_mask = intersect_children(node, wide, t_max, t_near); hit_mask != 0) {
                child = node.children[pop_lowest_bit(hit_mask)];
                if (hit_mask != 0) *top++ = {&node, hit_mask};
                continue;
            }
        }
        if (top == stack.data()) return false;
        --top;
        child = top->node->children[pop_lowest_bit(top->hit_mask)];
        if (top->hit_mask != 0) ++top;
    }
}

} // namespace rt::accel
