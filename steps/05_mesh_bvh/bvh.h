// A bounding volume hierarchy: nested boxes, so that a ray tests a handful of shapes instead of all of them.
#pragma once

#include "05_mesh_bvh/aabb.h"
#include "common/util/ray_stats.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

namespace rt {

/// A leaf holds primitive_indices[first_index] to primitive_indices[first_index + count - 1]; an inner node
/// (count 0) the nodes first_index and first_index + 1.
struct BvhNode {
    Aabb box;
    std::uint32_t first_index = 0;
    std::uint32_t count = 0;
};

/// It knows boxes and indices, never a triangle, so it works for any shape that has a box.
struct Bvh {
    std::vector<BvhNode> nodes;                   ///< the root is nodes[0]; empty without shapes
    std::vector<std::uint32_t> primitive_indices; ///< the numbers of the shapes, those of a leaf side by side
};

/// Where to split a set of shapes, and the expected cost of a ray through both halves.
struct Split {
    int axis = -1;
    float position = 0; ///< shapes whose middle lies below it go left
    float cost = infinity;
};

inline constexpr int bin_count = 16;
inline constexpr float sah_traversal_cost = 0.5f; ///< of one box test, in triangle tests
inline constexpr std::uint32_t max_leaf_size = 8; ///< never more shapes in a leaf

/// Returns the split along `axis` with the least surface area heuristic, among the borders of equal bins
/// (Wald 2007):
///     cost = (area_left count_left + area_right count_right) / area_parent.
inline Split find_best_split(std::span<const std::uint32_t> shapes, std::span<const Aabb> boxes,
                             const Aabb& centroid_bounds, float parent_area, int axis) {
    const float begin = centroid_bounds.min[axis];
    const float width = (centroid_bounds.max[axis] - begin) / bin_count;
    if (!(width > 0)) return {};
    //> at which border between two bins do a ray's tests cost least on average?
    std::array<Aabb, bin_count> bin_boxes;
    std::array<int, bin_count> counts{};
    for (const std::uint32_t shape : shapes) {
        const int bin = std::min(bin_count - 1, int((centroid(boxes[shape])[axis] - begin) / width));
        extend(bin_boxes[std::size_t(bin)], boxes[shape]);
        ++counts[std::size_t(bin)];
    }
    std::array<float, bin_count> right_cost{};
    Aabb box;
    int count = 0;
    for (std::size_t i = bin_count - 1; i > 0; --i) {
        extend(box, bin_boxes[i]);
        count += counts[i];
        right_cost[i] = half_area(box) * float(count);
    }
    Split best;
    box = {};
    count = 0;
    for (std::size_t i = 1; i < bin_count; ++i) {
        extend(box, bin_boxes[i - 1]);
        count += counts[i - 1];
        const float cost = (half_area(box) * float(count) + right_cost[i]) / parent_area;
        if (cost < best.cost && count > 0 && count < int(shapes.size()))
            best = {axis, begin + float(i) * width, cost};
    }
    return best;
    //< return {axis, begin + bin_count / 2 * width, 0};
}

/// Partitions `shapes` by the best SAH split and returns the size of the left part, or 0 to make a leaf.
/// Falls back to a median split on the longest axis if no split helps and the leaf would be too large.
inline std::size_t partition(std::span<std::uint32_t> shapes, std::span<const Aabb> boxes, const Aabb& box,
                             int depth) {
    Aabb centroid_bounds;
    for (const std::uint32_t shape : shapes) extend(centroid_bounds, centroid(boxes[shape]));
    Split best;
    for (int axis = 0; axis < 3 && depth < 48; ++axis) {
        const Split split = find_best_split(shapes, boxes, centroid_bounds, half_area(box), axis);
        if (split.cost < best.cost) best = split;
    }
    const float leaf_cost = float(shapes.size());
    if (shapes.size() <= max_leaf_size && !(best.cost + 2 * sah_traversal_cost < leaf_cost)) return 0;
    if (best.axis >= 0) {
        const auto goes_left = [&](std::uint32_t shape) {
            return centroid(boxes[shape])[best.axis] < best.position;
        };
        const auto split = std::partition(shapes.begin(), shapes.end(), goes_left);
        const auto count = std::size_t(split - shapes.begin());
        if (count > 0 && count < shapes.size()) return count;
    }
    const vec3 size = centroid_bounds.max - centroid_bounds.min;
    const int axis = size.x > size.y && size.x > size.z ? 0 : size.y > size.z ? 1 : 2;
    const auto half = shapes.begin() + std::ptrdiff_t(shapes.size() / 2);
    std::nth_element(shapes.begin(), half, shapes.end(), [&](std::uint32_t a, std::uint32_t b) {
        return centroid(boxes[a])[axis] < centroid(boxes[b])[axis];
    });
    return shapes.size() / 2;
}

/// Builds node `node` over the shapes primitive_indices[first_index] to
/// primitive_indices[first_index + count - 1], and everything below it.
inline void build_node(Bvh& bvh, std::span<const Aabb> boxes, std::uint32_t node, std::uint32_t first_index,
                       std::uint32_t count, int depth) {
    const std::span<std::uint32_t> shapes(bvh.primitive_indices.data() + first_index, count);
    Aabb box;
    for (const std::uint32_t shape : shapes) extend(box, boxes[shape]);
    bvh.nodes[node] = {box, first_index, count};
    if (count < 2) return;
    const auto left_count = std::uint32_t(partition(shapes, boxes, box, depth));
    if (left_count == 0) return;

    const auto left = std::uint32_t(bvh.nodes.size());
    bvh.nodes.resize(left + 2);
    bvh.nodes[node].first_index = left;
    bvh.nodes[node].count = 0;
    build_node(bvh, boxes, left, first_index, left_count, depth + 1);
    build_node(bvh, boxes, left + 1, first_index + left_count, count - left_count, depth + 1);
}

/// Builds the hierarchy over shapes 0, 1, ... with these boxes. Equal boxes give equal trees.
inline Bvh build_bvh(std::span<const Aabb> boxes) {
    Bvh bvh;
    if (boxes.empty()) return bvh;
    bvh.primitive_indices.resize(boxes.size());
    std::iota(bvh.primitive_indices.begin(), bvh.primitive_indices.end(), 0u);
    bvh.nodes.reserve(2 * boxes.size());
    bvh.nodes.resize(1);
    build_node(bvh, boxes, 0, 0, std::uint32_t(boxes.size()), 0);
    return bvh;
}

/// Calls leaf(index) for every shape whose box the ray enters, closest boxes first. The leaf function shrinks
/// ray.t_max when it finds a hit, and boxes beyond are then skipped; it returns true to end the traversal
/// (the first hit of a shadow ray).
template <typename Leaf>
void traverse(const Bvh& bvh, const Ray& ray, Leaf&& leaf) {
    struct StackEntry {
        std::uint32_t node;
        float t;
    };
    std::array<StackEntry, 96> stack; // at most 48 levels of SAH splits and 32 of halving
    int size = 0;
    const SlabRay slab = slab_ray(ray);
    const auto intersect_box = [&](std::uint32_t node) {
        ++ray_stats.box_tests;
        return intersect(bvh.nodes[node].box, slab, ray.t_min, ray.t_max);
    };
    if (bvh.nodes.empty()) return;
    if (const auto t = intersect_box(0)) stack[size++] = {0, *t};
    while (size > 0) {
        const StackEntry top = stack[std::size_t(--size)];
        if (top.t > ray.t_max) continue;
        const BvhNode& node = bvh.nodes[top.node];
        //> what is to do in a leaf, and what in an inner node, so that the nearer child comes first?
        if (node.count > 0) {
            for (std::uint32_t i = node.first_index; i < node.first_index + node.count; ++i)
                if (leaf(bvh.primitive_indices[i])) return;
            continue;
        }
        const auto left = intersect_box(node.first_index);
        const auto right = intersect_box(node.first_index + 1);
        const bool left_first = left && (!right || *left <= *right);
        if (left && !left_first) stack[std::size_t(size++)] = {node.first_index, *left};
        if (right) stack[std::size_t(size++)] = {node.first_index + 1, *right};
        if (left_first) stack[std::size_t(size++)] = {node.first_index, *left};
        //<
    }
}

} // namespace rt
