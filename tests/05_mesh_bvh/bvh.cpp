// Facts about the binary tree: how a ray traverses it, and the cost of traversal and construction.
// That the tree does not change what a ray hits is checked in 05_mesh_bvh_bvh_in_scenes.cpp.
#include "05_mesh_bvh/bvh.h"
#include "05_mesh_bvh/triangle.h"
#include "common/math/random.h"
#include "tests/check.h"
#include "tests/meshes.h"

#include <ctime>

using namespace rt;

namespace {

/// Returns the cost of rays between points around the unit cube, scaled by `scale`. It tests only triangles
/// and their tree, because a whole scene would take long to compile.
RayStats cost_of(const ObjModel& file, int rays, float scale = 1) {
    const Bvh bvh = build_bvh(boxes_of(file));
    Random random(5);
    ray_stats = {};
    for (int i = 0; i < rays; ++i) {
        const vec3 from = scale * (3.0f * random_point(random) - 1.0f);
        const vec3 to = scale * random_point(random);
        Ray ray{from, to - from};
        traverse(bvh, ray, [&](std::uint32_t shape) {
            const auto& corner = file.triangles[shape];
            const auto at = [&](std::size_t k) { return file.positions[std::size_t(corner[k].position)]; };
            ++ray_stats.triangle_tests;
            if (const auto hit = intersect(at(0), at(1), at(2), ray)) ray.t_max = hit->t;
            return false;
        });
    }
    return ray_stats;
}

/// How often a traversal did not test a shape whose box the ray enters, and how often it tested one again.
struct Visits {
    int missed = 0, twice = 0;
};

void count_visits(Visits& visits, const Bvh& bvh, const std::vector<Aabb>& boxes, const Ray& ray) {
    std::vector<int> asked(boxes.size());
    traverse(bvh, ray, [&](std::uint32_t shape) {
        ++asked[shape];
        return false;
    });
    for (std::size_t k = 0; k < boxes.size(); ++k) {
        visits.missed += asked[k] == 0 && intersect(boxes[k], ray);
        visits.twice += asked[k] > 1;
    }
}

} // namespace

// ----------------------------------------------------------------------------------------------- traversal

TEST_CASE("a traversal tests each shape whose box the ray enters and none twice") {
    const auto boxes = boxes_of(random_triangles(800, 0.3f));
    const Bvh bvh = build_bvh(boxes);
    Random random(51);
    Visits visits;
    for (int i = 0; i < 300; ++i)
        count_visits(visits, bvh, boxes, Ray{2.0f * random_point(random), random_direction(random)});
    CHECK_MESSAGE(visits.missed == 0, "shapes that were not tested");
    CHECK_MESSAGE(visits.twice == 0, "shapes that were tested twice");
}

TEST_CASE("a traversal of boxes whose size doubles a hundred times misses none of them") {
    const auto boxes = exponential_chain(-50, 50, {1, 0.9f, 1.1f});
    const Bvh bvh = build_bvh(boxes);
    Random random(55);
    Visits visits;
    for (const Aabb& box : boxes)
        for (int i = 0; i < 10; ++i) {
            const vec3 target = mix(box.min, box.max, random_point(random));
            const vec3 origin = length(box.max) * (3.0f * random_point(random) - 1.0f);
            count_visits(visits, bvh, boxes, Ray{origin, target - origin});
        }
    CHECK(visits.missed == 0);
    CHECK(visits.twice == 0);
}

TEST_CASE("a traversal ends immediately when a leaf requests it") {
    const Bvh bvh = build_bvh(std::vector<Aabb>(100, Aabb{{-1, -1, -1}, {1, 1, 1}}));
    int calls = 0;
    traverse(bvh, Ray{{0, 0, 5}, {0.01f, 0, -1}}, [&](std::uint32_t) { return ++calls == 3; });
    CHECK(calls == 3);
}

TEST_CASE("a traversal visits near boxes first and skips those beyond the closest hit") {
    for (int axis = 0; axis < 3; ++axis) {
        for (const float sign : {1.0f, -1.0f}) {
            std::vector<Aabb> row;
            vec3 along{0.01f};
            along[axis] = 1;
            for (int i = 0; i < 1000; ++i) {
                const vec3 p = float(2 * i) * along;
                row.push_back({p - 0.5f, p + 0.5f});
            }
            const Bvh bvh = build_bvh(row);
            const vec3 origin = (sign > 0 ? -5.0f : 2005.0f) * along;
            Ray ray{origin, sign * along};
            const SlabRay slab = slab_ray(ray);
            int calls = 0;
            ray_stats = {};
            traverse(bvh, ray, [&](std::uint32_t shape) {
                ++calls;
                if (const auto t = intersect(row[shape], slab, ray.t_min, ray.t_max)) ray.t_max = *t;
                return false;
            });
            INFO("axis ", axis, ", sign ", sign, ": ", calls, " shapes tested, ", ray_stats.box_tests,
                 " boxes");
            CHECK(ray.t_max < 20);
            CHECK_MESSAGE(
                calls <= 16,
                "about one leaf; 1,000: a hit does not shorten the ray, or the far child is visited first");
            CHECK(ray_stats.box_tests <= 100);
            CHECK(ray_stats.box_tests >= 5);
        }
    }
}

TEST_CASE("shapes behind a hit that was found are not tested any more") {
    std::vector<Aabb> heap; // 40 boxes close to the ray's origin and one far behind them
    Random random(52);
    for (int i = 0; i < 41; ++i) {
        const vec3 p = vec3(0, 0, i < 40 ? -5 : -500) + 0.1f * random_point(random);
        heap.push_back({p - 1.0f, p + 1.0f});
    }
    const Bvh bvh = build_bvh(heap);
    Ray ray{{0.1f, 0.2f, 0}, {0.001f, 0, -1}};
    int near_ones = 0, far_ones = 0;
    traverse(bvh, ray, [&](std::uint32_t shape) {
        ++(shape < 40 ? near_ones : far_ones);
        ray.t_max = std::min(ray.t_max, shape < 40 ? 5.0f : 500.0f);
        return false;
    });
    CHECK(ray.t_max == 5);
    CHECK_MESSAGE(near_ones == 40, "the ray enters each of the near boxes before t_max");
    CHECK_MESSAGE(far_ones == 0, "a box on the stack may be beyond t_max by the time it is popped");
}

// ---------------------------------------------------------------------------------------------------- cost

TEST_CASE("the work does not depend on the unit of length") {
    float triangles[3] = {}, boxes[3] = {};
    const float scales[] = {1, 1.0f / 1024, 1024};
    for (std::size_t i = 0; i < 3; ++i) {
        ObjModel file = random_triangles(2000, 0.2f);
        transform(file, scales[i], vec3(0));
        const RayStats cost = cost_of(file, 1000, scales[i]);
        triangles[i] = float(cost.triangle_tests);
        boxes[i] = float(cost.box_tests);
    }
    for (std::size_t i = 1; i < 3; ++i) {
        INFO("scale ", scales[i]);
        CHECK_MESSAGE(triangles[i] == approx(triangles[0], 0.05f),
                      "areas must be relative to that of the parent");
        CHECK(boxes[i] == approx(boxes[0], 0.05f));
    }
}

TEST_CASE("the best split has the least cost of all borders between bins and the cost that it claims") {
    // Boxes of very different sizes, so that the middle and a corner of a box are in different bins.
    Random random(54);
    int compared = 0;
    for (int round = 0; round < 60; ++round) {
        std::vector<Aabb> boxes;
        std::vector<std::uint32_t> all;
        Aabb parent, middles;
        for (std::uint32_t i = 0; i < 5 + std::uint32_t(round); ++i) {
            const vec3 low = random_point(random);
            const float size = 2 * std::pow(random.get_1d(), 4.0f);
            boxes.push_back({low, low + size * random_point(random)});
            all.push_back(i);
            extend(parent, boxes.back());
            extend(middles, centroid(boxes.back()));
        }
        for (int axis = 0; axis < 3; ++axis) {
            const float begin = middles.min[axis], width = (middles.max[axis] - begin) / bin_count;
            const auto cost_at = [&](float position) { // infinite if one side is empty
                Aabb left, right;
                int count = 0;
                for (const Aabb& box : boxes) {
                    const bool goes_left = centroid(box)[axis] < position;
                    extend(goes_left ? left : right, box);
                    count += goes_left;
                }
                const int rest = int(boxes.size()) - count;
                const float sum = half_area(left) * float(count) + half_area(right) * float(rest);
                return count == 0 || rest == 0 ? infinity : sum / half_area(parent);
            };
            const bool close_to_a_border = std::ranges::any_of(boxes, [&](const Aabb& box) {
                const float bin = (centroid(box)[axis] - begin) / width;
                return bin > 0.5f && bin < bin_count - 0.5f && std::abs(bin - std::round(bin)) < 1e-3f;
            });
            if (close_to_a_border) continue; // rounding may put it into either bin
            float least = infinity;
            for (int i = 1; i < bin_count; ++i) least = std::min(least, cost_at(begin + float(i) * width));
            const Split split = find_best_split(all, boxes, middles, half_area(parent), axis);
            ++compared;
            INFO(boxes.size(), " boxes, axis ", axis, ": the split at ", split.position);
            CHECK_MESSAGE(split.cost == approx(cost_at(split.position), 1e-3f),
                          "the cost of another split: shapes go left by the middles of their boxes");
            CHECK_MESSAGE(split.cost == approx(least, 1e-3f), "another border costs less");
        }
    }
    CHECK(compared > 60);
}

TEST_CASE("walls and floors with flat boxes make a good tree too") {
    ObjModel file = empty_file();
    Random random(53);
    for (int i = 0; i < 2000; ++i) { // small triangles in the three planes through the origin
        vec3 p = random_point(random), q = 0.05f * random_point(random), r = 0.05f * random_point(random);
        p[i % 3] = q[i % 3] = r[i % 3] = 0;
        add_triangle(file, p, p + q, p + r);
    }
    const RayStats cost = cost_of(file, 3000);
    INFO("triangle tests per ray ", float(cost.triangle_tests) / 3000);
    CHECK_MESSAGE(float(cost.box_tests) / 3000 < 45,
                  "70: the cost uses volume instead of area, and the volume of a flat box is 0");
    CHECK(float(cost.triangle_tests) / 3000 < 3);
}

TEST_CASE("building a tree of eight times as many triangles takes little more than eight times as long") {
    const auto seconds = [](int count) {
        const auto boxes = boxes_of(random_triangles(count, 0.02f));
        double best = 1e9; // of three, in processor time, so that other programs do not count
        for (int i = 0; i < 3; ++i) {
            const std::clock_t start = std::clock();
            const Bvh bvh = build_bvh(boxes);
            best = std::min(best, double(std::clock() - start) / CLOCKS_PER_SEC);
            CHECK(!bvh.nodes.empty());
        }
        return best;
    };
    const double few = seconds(8000), many = seconds(64000);
    CHECK_MESSAGE(many < 25 * few + 0.05, few, " s for 8,000, ", many,
                  " s for 64,000; 64 times: each level copies or visits all triangles");
}
