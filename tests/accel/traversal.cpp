// Facts about traversal: the wide tree finds the same hits as testing every primitive, with little work.
#include "accel/accel.h"
#include "05_mesh_bvh/mesh.h"
#include "common/math/random.h"
#include "tests/check.h"
#include "tests/meshes.h"

#include <string>

using namespace rt;

namespace {

/// A mesh of the lesson, whose triangles are tested one by one, and its tree.
struct Subject {
    Mesh mesh;
    accel::TriangleBvh bvh;

    explicit Subject(const ObjModel& file) {
        append_model(mesh, file, {0}, 0);
        bvh = accel::build_triangle_bvh(accel::TriangleMesh{mesh.positions, mesh.triangles});
    }
};

struct Closest {
    std::optional<float> t;
    std::uint32_t primitive = 0;
};

/// Finds the closest hit by the exact test of the lesson.
Closest brute_force(const Mesh& mesh, Ray ray) {
    Closest closest;
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
        const auto [a, b, c] = vertices(mesh, i);
        if (const auto hit = intersect(a, b, c, ray)) {
            ray.t_max = hit->t;
            closest = {hit->t, i};
        }
    }
    return closest;
}

/// Returns whether the point at t is on the triangle that is hit, up to a tolerance along its normal, because
/// only this deviation is visible; along a thin triangle that a ray grazes, t may differ.
bool is_on_surface(const Mesh& mesh, const Closest& right, const Ray& ray, float t) {
    const vec3 normal = vec3(normalize(area_normal(vertices(mesh, right.primitive))));
    const vec3 size = max(abs(ray.origin), abs(at(ray, *right.t)));
    return std::abs((t - *right.t) * dot(ray.direction, normal)) <=
           1e-6f * std::max({size.x, size.y, size.z});
}

/// Compares the tree with brute force for rays aimed at the box, from outside and from inside.
void check_tree(const Subject& subject, const Aabb& box, int count) {
    Random random(7);
    const float size = std::max(length(box.max - box.min), 1e-20f);
    int hits = 0, different = 0, shadows = 0;
    std::string first;
    for (int i = 0; i < count; ++i) {
        const vec3 target = mix(box.min, box.max, random_point(random));
        vec3 origin = (box.min + box.max) / 2.0f + size * random_direction(random);
        if (i % 4 == 0) origin = mix(box.min, box.max, random_point(random));
        Ray ray{origin, target - origin};
        if (i % 3 == 0) ray.t_max = 1.2f;
        const auto right = brute_force(subject.mesh, ray);
        const auto hit = accel::closest_hit(subject.bvh, ray);
        const bool same = right.t.has_value() == hit.has_value() &&
                          (!hit || is_on_surface(subject.mesh, right, ray, hit->t));
        hits += hit.has_value();
        shadows += accel::any_hit(subject.bvh, ray) != hit.has_value();
        if (!same && different++ == 0)
            first = "ray " + std::to_string(i) + " from " + to_text(ray.origin) + " along " +
                    to_text(ray.direction) + ": t = " + (right.t ? to_text(*right.t) : "none") + " and " +
                    (hit ? to_text(hit->t) : "none");
    }
    INFO(hits, " of ", count, " rays hit");
    CHECK_MESSAGE(different == 0, first,
                  " (none: a box is too small, or NaN rejects it; too far: the search ended too early)");
    CHECK_MESSAGE(shadows == 0, "any_hit() must agree with closest_hit()");
}

void check_tree(const ObjModel& file, int count) {
    const Subject subject(file);
    check_tree(subject, bounds(subject.mesh), count);
}

} // namespace

TEST_CASE("the tree finds the same hits as testing every triangle") {
    check_tree(random_triangles(2000, 0.15f), 1200);
    check_tree(flat_grid(20), 1500);
    check_tree(icosphere(3), 1500);
    ObjModel far = random_triangles(300, 0.3f);
    transform(far, 50, vec3(1e4f, -1e4f, 1e4f));
    check_tree(far, 2000);
    ObjModel small = random_triangles(300, 0.3f);
    transform(small, 1e-3f, vec3(0));
    check_tree(small, 2000);
}

TEST_CASE("the tree finds the same hits as testing every triangle among identical, flat and huge ones") {
    const vec3 a = {1, -2, 3}, b = {3, 1, 4}, c = {-1, 2, 6};
    ObjModel identical = empty_file();
    for (int i = 0; i < 100; ++i) add_triangle(identical, a, b, c);
    check_tree(identical, 1000);
    ObjModel file = empty_file();
    Random random(84);
    for (int i = 0; i < 300; ++i) {
        const vec3 p = random_point(random);
        add_triangle(file, p, p, p);
        add_triangle(file, p, p + random_direction(random), p + 0.01f * random_direction(random));
    }
    add_triangle(file, {-50, -0.2f, -50}, {-50, -0.2f, 100}, {100, -0.2f, -50});
    check_tree(Subject(file), {vec3(0), vec3(1)}, 2000);
}

TEST_CASE("no ray hits a tree without primitives") {
    const accel::Ray ray{vec3(0), vec3(1)};
    CHECK_FALSE(accel::closest_hit(accel::build_triangle_bvh(accel::TriangleMesh{}), ray));
    CHECK_FALSE(accel::any_hit(accel::build_triangle_bvh(std::span<const accel::TriangleMesh>()), ray));
    CHECK_FALSE(accel::closest_hit(accel::build_sphere_bvh({}), ray));
}

TEST_CASE("triangles are numbered consecutively through all meshes of a tree") {
    const vec3 vertices[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    std::vector<std::array<vec3, 3>> moved;
    for (int i = 0; i < 40; ++i)
        moved.push_back(
            {vertices[0] + vec3(0, 0, i), vertices[1] + vec3(0, 0, i), vertices[2] + vec3(0, 0, i)});
    const std::array<std::uint32_t, 3> triangle[] = {{0, 1, 2}};
    std::vector<accel::TriangleMesh> meshes;
    for (const auto& mesh : moved) {
        meshes.push_back({mesh, triangle});
        if (meshes.size() % 3 == 0) meshes.push_back({}); // has no triangle
    }
    const auto bvh = accel::build_triangle_bvh(meshes);
    for (int i = 0; i < 40; ++i) {
        const auto hit = accel::closest_hit(bvh, accel::Ray{{0.25f, 0.5f, float(i) - 0.5f}, {0, 0, 1}});
        REQUIRE(hit);
        CHECK(hit->primitive == std::uint32_t(i));
        CHECK(hit->t == 0.5f);
        CHECK(hit->u == 0.25f);
        CHECK(hit->v == 0.5f);
    }
}

TEST_CASE("a tree of spheres finds the same hits as testing every sphere to the last bit") {
    Random random(85);
    std::vector<accel::Sphere> spheres;
    for (int i = 0; i < 500; ++i) spheres.push_back({random_point(random), 0.08f * random.get_1d() + 1e-3f});
    const auto bvh = accel::build_sphere_bvh(spheres);
    int hits = 0, different = 0, shadows = 0;
    for (int i = 0; i < 3000; ++i) {
        const vec3 target = random_point(random);
        const vec3 origin = i % 4 == 0 ? random_point(random) : 0.5f + 2.0f * random_direction(random);
        const accel::Ray ray{origin, target - origin, 0, i % 3 == 0 ? 1.2f : infinity};
        accel::Ray rest = ray;
        std::uint32_t closest = 0;
        for (std::uint32_t s = 0; s < spheres.size(); ++s) {
            if (const auto hit = accel::exact_hit(spheres[s], rest)) {
                rest.t_max = hit->t;
                closest = s;
            }
        }
        const auto hit = accel::closest_hit(bvh, ray);
        hits += hit.has_value();
        different += hit ? hit->t != rest.t_max || hit->primitive != closest : rest.t_max != ray.t_max;
        shadows += accel::any_hit(bvh, ray) != hit.has_value();
    }
    CHECK(hits > 1000);
    CHECK(different == 0);
    CHECK(shadows == 0);
}

TEST_CASE("a ray aimed at an edge or a vertex that triangles share never slips through in float") {
    for (const float far : {1.0f, 30.0f, 3000.0f}) {
        const ObjModel files[] = {icosphere(3), flat_grid(24)};
        for (const ObjModel& file : files) {
            const Subject subject(file);
            Random random(82);
            int slipped = 0, shadows = 0;
            const int count = 4000;
            for (int i = 0; i < count; ++i) {
                const auto [a, b, c] = vertices(
                    subject.mesh, std::uint32_t(random.get_1d() * float(subject.mesh.triangles.size())));
                const float weight = i % 5 == 0 ? 0.0f : random.get_1d();
                const vec3 target = mix(a, b, weight);
                const bool rim = target.z == 0.3f && (std::min(target.x, target.y) < 1e-6f ||
                                                      std::max(target.x, target.y) > 1 - 1e-6f);
                if (rim) continue; // of the open grid: no neighbour
                const vec3 origin = far * random_direction(random) + vec3(0, 0, 2 * far);
                const bool sphere = file.triangles.size() == 1280;
                if (sphere && dot(normalize(target), normalize(origin - target)) < 0.2f)
                    continue; // the silhouette
                const Ray ray{origin, target - origin};
                slipped += !accel::closest_hit(subject.bvh, ray);
                shadows += !accel::any_hit(subject.bvh, ray);
            }
            INFO("from about ", far, " away, ", file.triangles.size(), " triangles");
            CHECK_MESSAGE(slipped == 0, "of ", count,
                          ": the two edge functions of a shared edge must be exact negatives");
            CHECK(shadows == 0);
        }
    }
}

namespace {

struct Counts {
    static inline std::size_t boxes, primitives;
    static void count_boxes(std::size_t count) { boxes += count; }
    static void count_primitives(std::size_t count) { primitives += count; }
};

} // namespace

TEST_CASE("among 2000 random triangles a ray visits few nodes and leaves") {
    const Subject subject(random_triangles(2000, 0.2f));
    Random random(5);
    const int rays = 3000;
    for (int i = 0; i < rays; ++i) {
        const vec3 from = 3.0f * random_point(random) - 1.0f, to = random_point(random);
        accel::closest_hit<Counts>(subject.bvh, Ray{from, to - from});
    }
    const double nodes = double(Counts::boxes) / accel::simd_width / rays,
                 leaves = double(Counts::primitives) / accel::simd_width / rays;
    INFO(nodes, " nodes and ", leaves, " leaves per ray");
    CHECK_MESSAGE(
        nodes < 64.0 / accel::simd_width,
        "more than twice that: nearer children are not visited first, or boxes beyond a hit are entered");
    CHECK_MESSAGE(leaves < 8, "15: the same, or the splits are poor");
    CHECK(leaves > 0.5);
}
