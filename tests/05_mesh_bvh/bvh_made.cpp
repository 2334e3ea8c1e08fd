// Facts about the construction of a binary tree: it loses no shape, and its depth fits the traversal stack.
#include "05_mesh_bvh/bvh.h"
#include "common/math/random.h"
#include "tests/check.h"
#include "tests/meshes.h"

#include <functional>

using namespace rt;

namespace {

/// Checks the invariants of every tree: each shape in one leaf, children inside parents. Returns the depth.
int check_tree(const std::vector<Aabb>& boxes) {
    const Bvh bvh = build_bvh(boxes);
    std::vector<int> times(boxes.size());
    int too_small = 0, largest_leaf = 0;
    const std::function<int(std::uint32_t)> visit = [&](std::uint32_t number) {
        REQUIRE(number < bvh.nodes.size());
        const BvhNode& node = bvh.nodes[number];
        if (node.count > 0) {
            largest_leaf = std::max(largest_leaf, int(node.count));
            for (std::uint32_t i = node.first_index; i < node.first_index + node.count; ++i) {
                REQUIRE(i < bvh.primitive_indices.size());
                ++times[bvh.primitive_indices[i]];
                too_small += !encloses(node.box, boxes[bvh.primitive_indices[i]]);
            }
            return 1;
        }
        REQUIRE(node.first_index > number);
        for (const std::uint32_t child : {node.first_index, node.first_index + 1})
            too_small += !encloses(node.box, bvh.nodes[child].box);
        return 1 + std::max(visit(node.first_index), visit(node.first_index + 1));
    };
    if (boxes.empty()) {
        CHECK(bvh.nodes.empty());
        return 0;
    }
    const int depth = visit(0);
    CHECK_MESSAGE(std::ranges::count(times, 1) == std::ptrdiff_t(times.size()),
                  "each shape must be in exactly one leaf: an off-by-one error loses or repeats some");
    CHECK_MESSAGE(too_small == 0, "each box must enclose everything below it");
    CHECK_MESSAGE(depth <= 90, "traversing this tree overflows a stack of fixed size");
    CHECK_MESSAGE(largest_leaf <= 16, "a leaf with this many shapes is no better than testing all of them");
    return depth;
}

} // namespace

TEST_CASE("each shape is in exactly one leaf and children are inside their parents") {
    check_tree(boxes_of(random_triangles(5000, 0.1f)));
    check_tree(boxes_of(flat_grid(30)));
    check_tree(boxes_of(icosphere(3)));
    for (int count = 0; count < 40; ++count) check_tree(boxes_of(random_triangles(count, 0.5f, 100)));
}

TEST_CASE("shapes with the same centroid are split all the same") {
    check_tree(std::vector<Aabb>(5000, Aabb{{1, 2, 3}, {4, 5, 6}}));
    std::vector<Aabb> shells;
    for (int i = 1; i <= 5000; ++i) shells.push_back({vec3(-float(i)), vec3(float(i))});
    const int depth = check_tree(shells);
    CHECK_MESSAGE(depth <= 40, "median splits of 5,000 shapes take about 13 levels");
}

TEST_CASE("shapes at one point, on one line or far away make a tree too") {
    check_tree(std::vector<Aabb>(300, Aabb{vec3(7), vec3(7)}));
    std::vector<Aabb> line, far, tiny;
    Random random(41);
    for (int i = 0; i < 1000; ++i) {
        line.push_back({vec3(float(i), 0, 0), vec3(float(i) + 0.5f, 0, 0)});
        const vec3 p = random_point(random);
        far.push_back({3e38f * (p - 0.5f), 3e38f * (p - 0.5f)});
        tiny.push_back({1e-40f * p, 1.01e-40f * p});
    }
    check_tree(line);
    check_tree(far);
    check_tree(tiny);
}

TEST_CASE("the depth of a tree over exponentially spaced shapes stays below the stack size") {
    check_tree(exponential_chain(-60, 60, {1, 1, 1}));
    check_tree(exponential_chain(-120, 120, {1, 0.5f, -0.3f}));
    std::vector<Aabb>
        star; // along six half-axes simultaneously, so that one axis after the other is exhausted
    for (const vec3 axis : {vec3(1, 1e-3f, 1e-3f), vec3(1e-3f, 1, 1e-3f), vec3(1e-3f, 1e-3f, 1)})
        for (const float sign : {1.0f, -1.0f})
            for (const Aabb& box : exponential_chain(-60, 60, sign * axis)) star.push_back(box);
    check_tree(star);
    std::vector<Aabb> nested; // boxes of growing size that share a corner
    for (int k = -60; k < 60; ++k)
        for (int i = 0; i < 12; ++i)
            nested.push_back({vec3(0), std::ldexp(1.0f, k) * vec3(1, 1 + 0.01f * float(i), 1)});
    check_tree(nested);
}

TEST_CASE("the same boxes give the same tree") {
    const auto boxes = boxes_of(random_triangles(1000, 0.1f));
    const Bvh one = build_bvh(boxes), two = build_bvh(boxes);
    CHECK(one.primitive_indices == two.primitive_indices);
    CHECK(one.nodes.size() == two.nodes.size());
}
