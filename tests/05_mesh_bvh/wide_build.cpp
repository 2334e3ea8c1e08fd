// How the wide tree is made: full, shallow, and the same on any number of threads.
#include "05_mesh_bvh/wide_build.h"
#include "common/util/parallel.h"
#include "tests/check.h"
#include "tests/meshes.h"

#include <functional>

using namespace rt;

namespace {

/// A tree over the boxes alone: its blocks remember numbers and nothing else.
struct alignas(WideNode) NumberBlock {
    std::array<std::uint32_t, lanes> shape{};
    int count = 0;
};

WideBvh<NumberBlock> tree_of(const std::vector<Aabb>& boxes) {
    return build_wide_bvh<NumberBlock>(
        boxes.size(), [&](std::uint32_t i) { return boxes[i]; },
        [](NumberBlock& block, int lane, std::uint32_t i) {
            block.shape[std::size_t(lane)] = i;
            block.count = std::max(block.count, lane + 1);
        });
}

Aabb lane_box(const WideNode& node, std::size_t lane) {
    Aabb box;
    for (int axis = 0; axis < 3; ++axis) {
        box.min[axis] = node.planes[axis][0][lane];
        box.max[axis] = node.planes[axis][1][lane];
    }
    return box;
}

bool is_empty(const Aabb& box) {
    return box.min.x > box.max.x;
}

/// What holds for every tree: each shape in one lane of one block, boxes around all below them.
void check_wide_tree(const std::vector<Aabb>& boxes) {
    const auto tree = tree_of(boxes);
    std::vector<int> times(boxes.size());
    int too_small = 0, deepest = 0, single_child = 0;
    const std::function<Aabb(std::uint32_t, int)> visit = [&](std::uint32_t child, int depth) {
        deepest = std::max(deepest, depth);
        Aabb all;
        if (is_block(child)) {
            const NumberBlock& block = block_at(tree, child);
            for (int i = 0; i < block.count; ++i) {
                const std::uint32_t shape = block.shape[std::size_t(i)];
                ++times[shape];
                extend(all, boxes[shape]);
            }
            return all;
        }
        const WideNode& node = node_at(tree, child);
        int children = 0;
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            const Aabb box = lane_box(node, lane);
            if (is_empty(box)) continue;
            ++children;
            too_small += !encloses(box, visit(node.child[lane], depth + 1));
            extend(all, box);
        }
        single_child += children < 2;
        return all;
    };
    if (boxes.empty()) {
        CHECK(tree.lines.empty());
        return;
    }
    visit(tree.root, 1);
    CHECK_MESSAGE(std::ranges::count(times, 1) == std::ptrdiff_t(times.size()),
                  "each shape lies in exactly one lane: an off-by-one in a cut loses or repeats some");
    CHECK_MESSAGE(too_small == 0, "each box holds all that is below it");
    CHECK_MESSAGE(single_child == 0, "a node with one child only costs time");
    CHECK_MESSAGE(deepest <= int(wide_depth), "a walk down this tree overflows its stack");
}

} // namespace

TEST_CASE("every shape lies in one lane of the wide tree, and every box holds what is below it") {
    check_wide_tree({});
    check_wide_tree(boxes_of(random_triangles(5000, 0.1f)));
    check_wide_tree(boxes_of(flat_grid(30)));
    check_wide_tree(boxes_of(icosphere(3)));
    for (int count = 1; count < 70; ++count) check_wide_tree(boxes_of(random_triangles(count, 0.5f, 100)));
    check_wide_tree(std::vector<Aabb>(5000, Aabb{{1, 2, 3}, {4, 5, 6}}));
    check_wide_tree(std::vector<Aabb>(300, Aabb{vec3(7), vec3(7)}));
}

TEST_CASE("the wide tree stays shallow where each cut splits off only a few, and at the ends of float") {
    check_wide_tree(exponential_chain(-60, 60, {1, 1, 1}));
    check_wide_tree(exponential_chain(-120, 120, {1, 0.5f, -0.3f}));
    std::vector<Aabb> nested;
    for (int i = 1; i < 500; ++i) nested.push_back({vec3(-float(i)), vec3(float(i))});
    check_wide_tree(nested);
    std::vector<Aabb> huge;
    for (int i = 0; i < 100; ++i) huge.push_back({vec3(-3e38f), vec3(3e38f) / float(i + 1)});
    check_wide_tree(huge);
}

TEST_CASE("the wide tree is the same on one thread and on many") {
    const auto boxes = boxes_of(random_triangles(60000, 0.02f));
    use_threads(1);
    const auto one = tree_of(boxes);
    use_threads(5);
    const auto many = tree_of(boxes);
    use_threads(0);
    REQUIRE(one.nodes == many.nodes);
    REQUIRE(one.blocks == many.blocks);
    int different = 0;
    const std::function<void(std::uint32_t)> visit = [&](std::uint32_t child) {
        if (is_block(child)) {
            different += block_at(one, child).shape != block_at(many, child).shape;
            return;
        }
        const WideNode &node = node_at(one, child), &other = node_at(many, child);
        different += node.child != other.child;
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            const Aabb box = lane_box(node, lane), same = lane_box(other, lane);
            different += box.min != same.min || box.max != same.max;
            if (!is_empty(box)) visit(node.child[lane]);
        }
    };
    visit(one.root);
    CHECK(different == 0);
}

TEST_CASE("nodes are nearly full: the binary tree is folded in the cheapest way") {
    const auto tree = tree_of(boxes_of(random_triangles(20000, 0.02f)));
    const double children = double(tree.nodes + tree.blocks - 1) / double(tree.nodes);
    const double shapes = 20000 / double(tree.blocks);
    INFO(children, " children a node, ", shapes, " shapes a block");
    CHECK_MESSAGE(children > 0.625 * lanes,
                  "half of that: nodes are filled from the top without weighing what is left below");
    CHECK_MESSAGE(shapes > 0.625 * lanes,
                  "half of that: the heuristic counts shapes, where it should count blocks");
}

TEST_CASE("weights of the fold: a subtree of two leaves takes two places or one node") {
    const auto weight = [](float area) { return Weight{row(area), IntRow{}, IntRow{} + 1}; };
    const Weight small = weight(3), large = weight(12); // leaves
    BinaryNode node{{vec3(0), vec3(3)}};                // 27
    const Weight parent = weigh(node, small, large);
    CHECK(parent.cost[0] == 3 + 12 + 27);
    CHECK(node.nodes == 1);
    for (int places = 2; places < lanes; ++places) {
        CHECK(parent.cost[places - 1] == 3 + 12);
        CHECK_MESSAGE(parent.nodes[places - 1] == 0, "both leaves find room in the node above");
    }
    CHECK(node.share[1] == 1);
    BinaryNode node_above{{vec3(0), vec3(4)}}; // 48
    const Weight above = weigh(node_above, parent, small);
    CHECK(above.cost[0] == 3 + 12 + 3 + 48);
    CHECK(above.nodes[0] == 1);
    CHECK_MESSAGE(above.cost[1] == 3 + 12 + 27 + 3, "in two places one of them must be a node of its own");
    CHECK(above.nodes[1] == 1);
    CHECK(above.cost[2] == 3 + 12 + 3);
    CHECK(above.nodes[2] == 0);
    CHECK(above.leaves[2] == 3);
}

TEST_CASE(
    "weights of the fold: shapes that fit into one block become one, unless two are cheaper and find room") {
    const auto weight = [](float area) { return Weight{row(area), IntRow{}, IntRow{} + 1}; };
    BinaryNode near{{vec3(0), vec3(3)}, nullptr, 0, lanes}; // 27
    const Weight together = weigh(near, weight(20), weight(10));
    for (int places = 1; places < lanes; ++places) {
        CHECK(together.cost[places - 1] == 27);
        CHECK(together.leaves[places - 1] == 1);
        CHECK(together.nodes[places - 1] == 0);
    }
    BinaryNode far{{vec3(0), vec3(3)}, nullptr, 0, lanes};
    const Weight apart = weigh(far, weight(12), weight(3));
    CHECK_MESSAGE(apart.cost[0] == 27, "in one place they are one block");
    CHECK(apart.leaves[0] == 1);
    CHECK(apart.cost[1] == 12 + 3);
    CHECK(apart.leaves[1] == 2);
    CHECK(far.share[1] == 1);
    CHECK((far.nodes == 0 && far.leaves == 1));
}
