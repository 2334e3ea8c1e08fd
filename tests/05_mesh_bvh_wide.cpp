// Facts about rows of eight numbers, blocks of eight shapes, and the tree that is made of them.
#include "05_mesh_bvh/scene.h"
#include "tests/check.h"
#include "tests/meshes.h"

#include <functional>

using namespace rt;

namespace {

Scene prepared(const ObjFile& file, Accel accel = Accel::wide) {
    Scene scene;
    scene.accel = accel;
    add(scene, file, 0);
    prepare(scene);
    return scene;
}

/// How far the point at t lies off the surface of the true hit. A ray that grazes a splinter may be off along
/// the surface, which nobody sees; off the surface it must keep to the error that hit.h promises.
bool on_the_surface(const Hit& right, const Ray& ray, float t) {
    return std::abs((t - right.t) * dot(ray.direction, right.geometric_normal)) <= right.error;
}

/// A tree over the boxes alone: its blocks remember numbers and nothing else.
struct alignas(64) NumberBlock {
    std::array<std::uint32_t, lanes> shape{};
    int count = 0;
};

WideBvh<NumberBlock> tree_of(const std::vector<Box>& boxes) {
    return build_wide_bvh<NumberBlock>(
        boxes.size(), [&](std::uint32_t i) { return boxes[i]; },
        [](NumberBlock& block, int lane, std::uint32_t i) {
            block.shape[std::size_t(lane)] = i;
            block.count = std::max(block.count, lane + 1);
        });
}

bool encloses(const Box& outer, const Box& inner) {
    return all(lessThanEqual(outer.low, inner.low)) && all(greaterThanEqual(outer.high, inner.high));
}

Box lane_box(const WideNode& node, std::size_t lane) {
    Box box;
    for (int axis = 0; axis < 3; ++axis) {
        box.low[axis] = node.planes[axis][0][lane];
        box.high[axis] = node.planes[axis][1][lane];
    }
    return box;
}

bool is_empty(const Box& box) {
    return box.low.x > box.high.x;
}

/// What holds for every tree: each shape in one lane of one block, boxes around all below them.
void check_wide_tree(const std::vector<Box>& boxes) {
    const auto tree = tree_of(boxes);
    std::vector<int> times(boxes.size());
    int too_small = 0, deepest = 0, single_child = 0;
    const std::function<Box(std::uint32_t, int)> visit = [&](std::uint32_t child, int depth) {
        deepest = std::max(deepest, depth);
        Box all;
        if (is_block(child)) {
            const NumberBlock& block = block_at(tree, child);
            for (int i = 0; i < block.count; ++i) {
                const std::uint32_t shape = block.shape[std::size_t(i)];
                ++times[shape];
                grow(all, boxes[shape]);
            }
            return all;
        }
        const WideNode& node = node_at(tree, child);
        int children = 0;
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            const Box box = lane_box(node, lane);
            if (is_empty(box)) continue;
            ++children;
            too_small += !encloses(box, visit(node.child[lane], depth + 1));
            grow(all, box);
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

struct Comparison {
    int rays = 0, hits = 0, different = 0, shadows = 0;
    std::string first;
};

/// Rays at the box, from without and from within, by the wide tree and by asking every shape.
Comparison compare_with_brute(const Scene& scene, const Box& box, int count, std::uint64_t seed = 7) {
    Scene brute = scene, wide = scene;
    brute.accel = Accel::brute;
    wide.accel = Accel::wide;
    prepare(wide);
    Comparison result;
    Random random(seed);
    const float size = std::max(length(box.high - box.low), 1e-20f);
    for (int i = 0; i < count; ++i) {
        const vec3 target = mix(box.low, box.high, random_point(random));
        vec3 origin = (box.low + box.high) / 2.0f + size * random_direction(random);
        if (i % 4 == 0) origin = mix(box.low, box.high, random_point(random));
        Ray ray{origin, target - origin};
        if (i % 3 == 0) ray.t_max = 1.2f;
        const auto right = intersect(brute, ray), got = intersect(wide, ray);
        const bool same =
            right.has_value() == got.has_value() && (!right || on_the_surface(*right, ray, got->t));
        result.hits += right.has_value();
        result.shadows += occluded(wide, ray) != got.has_value();
        if (!same && result.different++ == 0)
            result.first = "ray " + std::to_string(i) + " from " + to_text(ray.origin) + " along " +
                           to_text(ray.direction) + ": t = " + (right ? to_text(right->t) : "none") +
                           " and " + (got ? to_text(got->t) : "none");
    }
    result.rays = count;
    return result;
}

void check_wide_changes_nothing(const Scene& scene, const Box& box, int count) {
    const Comparison result = compare_with_brute(scene, box, count);
    INFO(result.hits, " of ", result.rays, " rays hit");
    CHECK_MESSAGE(result.different == 0, result.first,
                  " (none: a box is too small, or NaN rejects it; too far: the search ended too soon)");
    CHECK_MESSAGE(result.shadows == 0, "any_hit() must agree with nearest()");
}

void check_wide_changes_nothing(const ObjFile& file, int count) {
    const Scene scene = prepared(file);
    check_wide_changes_nothing(scene, bounds(scene.mesh), count);
}

} // namespace

// ------------------------------------------------------------------------------------------------ rows

TEST_CASE("bits of a mask stand in the order of the lanes") {
    const Row values = {3, -1, 4, -1, -5, 9, -2, 6};
    CHECK(bits(values < 0) == 0b01011010u);
    CHECK(bits(values < -10) == 0);
    CHECK(bits(values > -10) == 0xffu);
    unsigned mask = 0b01011010u;
    CHECK(next_lane(mask) == 1);
    CHECK(next_lane(mask) == 3);
    CHECK(mask == 0b01010000u);
}

TEST_CASE("least and greatest answer the second where one is not a number") {
    const float nan = std::nanf("");
    const Row a = {1, 5, nan, 2, nan, 0, 7, -3}, b = {2, 4, 3, nan, nan, -1, 7, 8};
    CHECK(least(a, b)[0] == 1);
    CHECK(least(a, b)[1] == 4);
    CHECK(least(a, b)[2] == 3);
    CHECK(greatest(a, b)[0] == 2);
    CHECK(greatest(a, b)[2] == 3);
    CHECK(std::isnan(greatest(a, b)[3]));
}

// ---------------------------------------------------------------------------------------------- blocks

TEST_CASE("a block of triangles answers what each triangle answers alone") {
    Random random(81);
    int hits = 0, wrong = 0;
    for (int round = 0; round < 400; ++round) {
        TriangleBlock block{};
        std::array<std::array<vec3, 3>, lanes> triangles;
        const int filled = 1 + round % lanes;
        for (int lane = 0; lane < filled; ++lane) {
            auto& corners = triangles[std::size_t(lane)];
            for (vec3& corner : corners) corner = 3.0f * random_point(random) + vec3(2, -1, 0.5f);
            put(block, lane, corners, std::uint32_t(100 + lane));
        }
        const vec3 origin = 8.0f * random_direction(random),
                   target = 3.0f * random_point(random) + vec3(2, -1, 0.5f);
        const Ray ray{origin, 0.7f * (target - origin), 0.2f, 1.6f};
        const BlockHits got = intersect(block, block_ray(ray), row(ray.t_min), row(ray.t_max));
        for (int lane = 0; lane < lanes; ++lane) {
            const bool hit = bits(got.hit) >> lane & 1;
            if (lane >= filled) {
                CHECK_MESSAGE(!hit, "an empty lane is never hit");
                continue;
            }
            const auto& [a, b, c] = triangles[std::size_t(lane)];
            const auto right = intersect(a, b, c, ray);
            hits += hit;
            if (right.has_value() != hit) ++wrong;
            if (!right || !hit) continue;
            CHECK(got.t[lane] == approx(right->t, 1e-4f));
            CHECK_MESSAGE(vec2(got.u[lane], got.v[lane]) == approx(vec2(right->u, right->v), 2e-3f),
                          "u weighs the second corner and v the third");
        }
    }
    CHECK(hits > 100);
    CHECK_MESSAGE(wrong <= 1, "only a ray within rounding of an edge may be judged in two ways");
}

TEST_CASE("a ray that aims at an edge or a corner that triangles share never slips through, in float") {
    for (const float far : {1.0f, 30.0f, 3000.0f}) {
        const ObjFile files[] = {icosphere(3), flat_grid(24)};
        for (const ObjFile& file : files) {
            const Scene scene = prepared(file);
            Random random(82);
            int slipped = 0, shadows = 0;
            const int count = 4000;
            for (int i = 0; i < count; ++i) {
                const auto corner =
                    corners(scene.mesh, std::uint32_t(random.uniform() * float(scene.mesh.triangles.size())));
                const float weight = i % 5 == 0 ? 0.0f : random.uniform();
                const vec3 target = mix(corner[0], corner[1], weight);
                const bool rim = target.z == 0.3f && (std::min(target.x, target.y) < 1e-6f ||
                                                      std::max(target.x, target.y) > 1 - 1e-6f);
                if (rim) continue; // of the open grid: there is no neighbour
                const vec3 origin = far * random_direction(random) + vec3(0, 0, 2 * far);
                const bool ball = file.triangles.size() == 1280;
                if (ball && dot(normalize(target), normalize(origin - target)) < 0.2f)
                    continue; // the outline
                const Ray ray{origin, target - origin};
                slipped += !intersect(scene, ray);
                shadows += !occluded(scene, ray);
            }
            INFO("from about ", far, " away, ", file.triangles.size(), " triangles");
            CHECK_MESSAGE(slipped == 0, "of ", count,
                          ": the two edge functions of a shared edge must be exact negatives");
            CHECK(shadows == 0);
        }
    }
}

TEST_CASE("a triangle is met at any size, and from both sides, eight at a time") {
    const vec3 a = {1, -2, 3}, b = {3, 1, 4}, c = {-1, 2, 6};
    for (const float size : {1e-8f, 1e-3f, 1.0f, 1e4f, 1e8f}) {
        for (const float side : {1.0f, -1.0f}) {
            TriangleBlock block{};
            put(block, 5, {size * a, size * b, size * c}, 7);
            const vec3 target = (0.2f * a + 0.3f * b + 0.5f * c) * size;
            const vec3 from = target + side * size * vec3(4, -3, 9);
            const BlockHits hits = intersect(block, block_ray({from, target - from}), row(0), row(infinity));
            INFO("size ", size, ", side ", side);
            REQUIRE(bits(hits.hit) == 1u << 5);
            CHECK(hits.t[5] == approx(1, 1e-5f));
            CHECK(vec2(hits.u[5], hits.v[5]) == approx({0.3f, 0.5f}, 1e-4f));
        }
    }
}

TEST_CASE("a block of spheres answers what each sphere answers alone") {
    Random random(83);
    int hits = 0;
    for (int round = 0; round < 500; ++round) {
        SphereBlock block{};
        std::array<Sphere, lanes> spheres;
        const int filled = 1 + round % lanes;
        for (int lane = 0; lane < filled; ++lane) {
            spheres[std::size_t(lane)] = {4.0f * random_point(random), 2 * random.uniform() + 0.01f, 0};
            if (lane == 3) spheres[3] = {{1, -1000, 2}, 1000, 0}; // a floor
            put(block, lane, spheres[std::size_t(lane)], std::uint32_t(lane));
        }
        const Ray ray{4.0f * random_point(random), random_direction(random), 0.1f, 6.0f};
        const BlockHits got = intersect(block, block_ray(ray), row(ray.t_min), row(ray.t_max));
        for (int lane = 0; lane < lanes; ++lane) {
            const auto right = lane < filled ? intersect(spheres[std::size_t(lane)], ray) : std::nullopt;
            const bool hit = bits(got.hit) >> lane & 1;
            CHECK_MESSAGE(hit == right.has_value(),
                          "the far root counts from inside, and an empty lane never");
            if (hit && right) CHECK(got.t[lane] == *right);
            hits += hit;
        }
    }
    CHECK(hits > 200);
}

// ------------------------------------------------------------------------------------------------ tree

TEST_CASE("every shape lies in one lane of the wide tree, and every box holds what is below it") {
    check_wide_tree({});
    check_wide_tree(boxes_of(random_triangles(5000, 0.1f)));
    check_wide_tree(boxes_of(flat_grid(30)));
    check_wide_tree(boxes_of(icosphere(3)));
    for (int count = 1; count < 70; ++count) check_wide_tree(boxes_of(random_triangles(count, 0.5f, 100)));
    check_wide_tree(std::vector<Box>(5000, Box{{1, 2, 3}, {4, 5, 6}}));
    check_wide_tree(std::vector<Box>(300, Box{vec3(7), vec3(7)}));
}

TEST_CASE("the wide tree stays shallow where each cut splits off only a few, and at the ends of float") {
    check_wide_tree(exponential_chain(-60, 60, {1, 1, 1}));
    check_wide_tree(exponential_chain(-120, 120, {1, 0.5f, -0.3f}));
    std::vector<Box> nested;
    for (int i = 1; i < 500; ++i) nested.push_back({vec3(-float(i)), vec3(float(i))});
    check_wide_tree(nested);
    std::vector<Box> huge;
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
            const Box box = lane_box(node, lane), same = lane_box(other, lane);
            different += box.low != same.low || box.high != same.high;
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
    CHECK_MESSAGE(children > 5, "3 to 4: nodes are filled from the top without weighing what is left below");
    CHECK_MESSAGE(shapes > 5, "4: the heuristic counts shapes, where it should count blocks");
}

TEST_CASE("weights of the fold: a subtree of two leaves takes two places or one node") {
    const auto weight = [](float area) { return Weight{row(area), Mask{}}; };
    const Weight small = weight(3), large = weight(12); // leaves
    BinaryNode node{{vec3(0), vec3(3)}};                // 27
    const Weight parent = weigh(node, small, large);
    CHECK(parent.cost[0] == 3 + 12 + 27);
    CHECK(node.nodes == 1);
    for (int places = 2; places <= 7; ++places) {
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
}

TEST_CASE("the wide tree finds what asking every shape finds") {
    check_wide_changes_nothing(random_triangles(2000, 0.15f), 1200);
    check_wide_changes_nothing(flat_grid(20), 1500);
    check_wide_changes_nothing(icosphere(3), 1500);
    ObjFile far = random_triangles(300, 0.3f);
    transform(far, 50, vec3(1e4f, -1e4f, 1e4f));
    check_wide_changes_nothing(far, 2000);
    ObjFile small = random_triangles(300, 0.3f);
    transform(small, 1e-3f, vec3(0));
    check_wide_changes_nothing(small, 2000);
}

TEST_CASE("the wide tree finds what asking every shape finds, among identical, flat and huge triangles") {
    const vec3 a = {1, -2, 3}, b = {3, 1, 4}, c = {-1, 2, 6};
    ObjFile identical = empty_file();
    for (int i = 0; i < 100; ++i) add_triangle(identical, a, b, c);
    check_wide_changes_nothing(identical, 1000);
    ObjFile file = empty_file();
    Random random(84);
    for (int i = 0; i < 300; ++i) {
        const vec3 p = random_point(random);
        add_triangle(file, p, p, p);
        add_triangle(file, p, p + random_direction(random), p + 0.01f * random_direction(random));
    }
    add_triangle(file, {-50, -0.2f, -50}, {-50, -0.2f, 100}, {100, -0.2f, -50});
    check_wide_changes_nothing(prepared(file), {vec3(0), vec3(1)}, 2000);
}

TEST_CASE("the wide tree finds spheres, quads and planes among triangles") {
    Random random(85);
    Scene scene;
    const int grey = add(scene, Diffuse{vec3(0.5f)});
    for (int i = 0; i < 500; ++i)
        scene.spheres.push_back({random_point(random), 0.08f * random.uniform() + 1e-3f, grey});
    check_wide_changes_nothing(scene, {vec3(0), vec3(1)}, 1500);
    scene.planes = {{{0, 0.3f, 0}, normalize(vec3(0.1f, 1, 0)), grey}};
    for (int i = 0; i < 40; ++i)
        scene.quads.push_back(
            {random_point(random), 0.3f * random_point(random), 0.3f * random_direction(random), grey});
    add(scene, random_triangles(500, 0.2f), 40);
    check_wide_changes_nothing(scene, {vec3(0), vec3(1)}, 2000);
}

TEST_CASE("a quad in the wide tree has the hit of a quad, in both of its halves") {
    Scene scene;
    add(scene, Diffuse{vec3(0.5f)});
    const int second = add(scene, Diffuse{vec3(0.7f)});
    scene.quads = {{{1, 0.5f, -2}, {2, 0.3f, 0.1f}, {-0.2f, 1.5f, 0.4f}, second}};
    prepare(scene);
    Random random(86);
    for (int i = 0; i < 300; ++i) {
        const vec2 uv = 0.002f + 0.996f * random.uniform2();
        const vec3 target =
            scene.quads[0].corner + uv.x * scene.quads[0].edge_u + uv.y * scene.quads[0].edge_v;
        const vec3 origin = target + 3.0f * random_direction(random);
        const auto hit = intersect(scene, Ray{origin, target - origin});
        REQUIRE_MESSAGE(hit, "u, v = ", uv, ": one of the two halves is missing");
        CHECK(hit->uv == approx(uv, 1e-3f));
        CHECK(hit->material == second);
        CHECK(hit->position == approx(target, 1e-4f));
    }
}

TEST_CASE("among 2,000 random triangles a ray asks few nodes and blocks") {
    const Scene scene = prepared(random_triangles(2000, 0.2f));
    Random random(5);
    tally = {};
    const int rays = 3000;
    for (int i = 0; i < rays; ++i) {
        const vec3 from = 3.0f * random_point(random) - 1.0f, to = random_point(random);
        intersect(scene, Ray{from, to - from});
    }
    const double nodes = double(tally.box_tests) / lanes / rays,
                 blocks = double(tally.triangle_tests) / lanes / rays;
    INFO(nodes, " nodes and ", blocks, " blocks a ray");
    CHECK_MESSAGE(nodes < 8, "20: nearer children do not come first, or boxes beyond a hit are entered");
    CHECK_MESSAGE(blocks < 8, "15: the same, or the cut is a bad one");
    CHECK(blocks > 0.5);
}
