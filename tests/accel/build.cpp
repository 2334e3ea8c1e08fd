// Facts about the construction of the wide tree: full nodes, low depth, and no dependence on threads.
#include "accel/build.h"
#include "common/util/parallel.h"
#include "tests/check.h"
#include "tests/meshes.h"

#include <functional>

using namespace rt;
using namespace rt::accel;

namespace {

/// A leaf block that holds only the indices of its primitives.
struct alignas(WideNode) IndexBlock {
    std::array<std::uint32_t, simd_width> primitive{};
    int count = 0;
};

Bounds bounds_of(const Aabb& box) {
    return {box.min, box.max};
}

WideBvh<IndexBlock> tree_of(const std::vector<Aabb>& boxes) {
    return build_wide_bvh<IndexBlock>(
        boxes.size(), [&](std::uint32_t i) { return bounds_of(boxes[i]); },
        [](IndexBlock& block, int lane, std::uint32_t i) {
            block.primitive[std::size_t(lane)] = i;
            block.count = std::max(block.count, lane + 1);
        });
}

Aabb lane_box(const WideNode& node, std::size_t lane) {
    Aabb box;
    for (int axis = 0; axis < 3; ++axis) {
        box.min[axis] = node.bounds[axis][0][lane];
        box.max[axis] = node.bounds[axis][1][lane];
    }
    return box;
}

bool is_empty(const Aabb& box) {
    return box.min.x > box.max.x;
}

/// Checks the invariants of every tree: each primitive in one lane of one block,
/// boxes enclose all below them.
void check_wide_tree(const std::vector<Aabb>& boxes) {
    const auto tree = tree_of(boxes);
    std::vector<int> times(boxes.size());
    int too_small = 0, deepest = 0, single_child = 0;
    const std::function<Aabb(std::uint32_t, int)> visit = [&](std::uint32_t child, int depth) {
        deepest = std::max(deepest, depth);
        Aabb all;
        if (is_leaf(child)) {
            const IndexBlock& block = leaf_at(tree, child);
            for (int i = 0; i < block.count; ++i) {
                const std::uint32_t primitive = block.primitive[std::size_t(i)];
                ++times[primitive];
                extend(all, boxes[primitive]);
            }
            return all;
        }
        const WideNode& node = node_at(tree, child);
        int children = 0;
        for (std::size_t lane = 0; lane < simd_width; ++lane) {
            const Aabb box = lane_box(node, lane);
            if (is_empty(box)) continue;
            ++children;
            too_small += !encloses(box, visit(node.children[lane], depth + 1));
            extend(all, box);
        }
        single_child += children < 2;
        return all;
    };
    if (boxes.empty()) {
        CHECK(tree.storage.empty());
        return;
    }
    visit(tree.root, 1);
    CHECK_MESSAGE(
        std::ranges::count(times, 1) == std::ptrdiff_t(times.size()),
        "each primitive must be in exactly one lane: an off-by-one error in a split loses or repeats some");
    CHECK_MESSAGE(too_small == 0, "each box must enclose everything below it");
    CHECK_MESSAGE(single_child == 0, "a node with only one child wastes time");
    CHECK_MESSAGE(deepest <= int(max_depth), "a traversal of this tree overflows its stack");
}

} // namespace

TEST_CASE("every primitive is in one lane of the wide tree, and every box encloses everything below it") {
    check_wide_tree({});
    check_wide_tree(boxes_of(random_triangles(5000, 0.1f)));
    check_wide_tree(boxes_of(flat_grid(30)));
    check_wide_tree(boxes_of(icosphere(3)));
    for (int count = 1; count < 70; ++count) check_wide_tree(boxes_of(random_triangles(count, 0.5f, 100)));
    check_wide_tree(std::vector<Aabb>(5000, Aabb{{1, 2, 3}, {4, 5, 6}}));
    check_wide_tree(std::vector<Aabb>(300, Aabb{vec3(7), vec3(7)}));
}

TEST_CASE("the wide tree stays shallow where each split separates only a few and at the limits of float") {
    check_wide_tree(exponential_chain(-60, 60, {1, 1, 1}));
    check_wide_tree(exponential_chain(-120, 120, {1, 0.5f, -0.3f}));
    std::vector<Aabb> nested;
    for (int i = 1; i < 500; ++i) nested.push_back({vec3(-float(i)), vec3(float(i))});
    check_wide_tree(nested);
    std::vector<Aabb> huge;
    for (int i = 0; i < 100; ++i) huge.push_back({vec3(-3e38f), vec3(3e38f) / float(i + 1)});
    check_wide_tree(huge);
}

TEST_CASE("the wide tree is the same on one thread and on many threads") {
    const auto boxes = boxes_of(random_triangles(60000, 0.02f));
    set_thread_count(1);
    const auto one = tree_of(boxes);
    set_thread_count(5);
    const auto many = tree_of(boxes);
    set_thread_count(0);
    REQUIRE(one.node_count == many.node_count);
    REQUIRE(one.leaf_count == many.leaf_count);
    int different = 0;
    const std::function<void(std::uint32_t)> visit = [&](std::uint32_t child) {
        if (is_leaf(child)) {
            different += leaf_at(one, child).primitive != leaf_at(many, child).primitive;
            return;
        }
        const WideNode &node = node_at(one, child), &other = node_at(many, child);
        different += node.children != other.children;
        for (std::size_t lane = 0; lane < simd_width; ++lane) {
            const Aabb box = lane_box(node, lane), same = lane_box(other, lane);
            different += box.min != same.min || box.max != same.max;
            if (!is_empty(box)) visit(node.children[lane]);
        }
    };
    visit(one.root);
    CHECK(different == 0);
}

TEST_CASE("nodes are nearly full because the binary tree is collapsed at the lowest cost") {
    const auto tree = tree_of(boxes_of(random_triangles(20000, 0.02f)));
    const double children = double(tree.node_count + tree.leaf_count - 1) / double(tree.node_count);
    const double primitives = 20000 / double(tree.leaf_count);
    INFO(children, " children per node, ", primitives, " primitives per block");
    CHECK_MESSAGE(children > 0.625 * simd_width,
                  "half of that: nodes are filled from the top without the cost of the subtrees below");
    CHECK_MESSAGE(primitives > 0.625 * simd_width,
                  "half of that: the heuristic counts primitives instead of blocks");
}

TEST_CASE("cost of collapsing: a subtree of two leaves takes two slots or one node") {
    const auto leaf = [](float area) { return CollapseCost{broadcast(area), IntN{}, IntN{} + 1}; };
    const CollapseCost small = leaf(3), large = leaf(12); // leaves
    BinaryNode node{{vec3(0), vec3(3)}};                  // 27
    const CollapseCost parent = collapse_cost(node, small, large);
    CHECK(parent.cost[0] == 3 + 12 + 27);
    CHECK(node.nodes == 1);
    for (int slots = 2; slots < simd_width; ++slots) {
        CHECK(parent.cost[slots - 1] == 3 + 12);
        CHECK_MESSAGE(parent.nodes[slots - 1] == 0, "both leaves fit into the parent node");
    }
    CHECK(node.left_slots[1] == 1);
    BinaryNode node_above{{vec3(0), vec3(4)}}; // 48
    const CollapseCost above = collapse_cost(node_above, parent, small);
    CHECK(above.cost[0] == 3 + 12 + 3 + 48);
    CHECK(above.nodes[0] == 1);
    CHECK_MESSAGE(above.cost[1] == 3 + 12 + 27 + 3, "with two slots, one of the children must be a node");
    CHECK(above.nodes[1] == 1);
    CHECK(above.cost[2] == 3 + 12 + 3);
    CHECK(above.nodes[2] == 0);
    CHECK(above.leaves[2] == 3);
}

TEST_CASE("cost of collapsing: primitives that fit into one block become one block, unless two blocks are "
          "cheaper and fit") {
    const auto leaf = [](float area) { return CollapseCost{broadcast(area), IntN{}, IntN{} + 1}; };
    BinaryNode near{{vec3(0), vec3(3)}, nullptr, 0, simd_width}; // 27
    const CollapseCost together = collapse_cost(near, leaf(20), leaf(10));
    for (int slots = 1; slots < simd_width; ++slots) {
        CHECK(together.cost[slots - 1] == 27);
        CHECK(together.leaves[slots - 1] == 1);
        CHECK(together.nodes[slots - 1] == 0);
    }
    BinaryNode far{{vec3(0), vec3(3)}, nullptr, 0, simd_width};
    const CollapseCost apart = collapse_cost(far, leaf(12), leaf(3));
    CHECK_MESSAGE(apart.cost[0] == 27, "with one slot they are one block");
    CHECK(apart.leaves[0] == 1);
    CHECK(apart.cost[1] == 12 + 3);
    CHECK(apart.leaves[1] == 2);
    CHECK(far.left_slots[1] == 1);
    CHECK((far.nodes == 0 && far.leaves == 1));
}
