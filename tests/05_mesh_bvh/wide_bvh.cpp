// The wide tree finds what asking every shape finds, lets no ray slip through, and asks
// little.
#include "05_mesh_bvh/scene.h"
#include "common/math/random.h"
#include "tests/check.h"
#include "tests/meshes.h"

using namespace rt;

namespace {

Scene prepared(const ObjModel& file, Accel accel = Accel::wide) {
    Scene scene;
    scene.accel = accel;
    add_model(scene, file, 0);
    build_bvhs(scene);
    return scene;
}

/// How far the point at t lies off the surface of the true hit. A ray that grazes a splinter may be off along
/// the surface, which nobody sees; off the surface it must keep to the error that hit.h promises.
bool on_the_surface(const Hit& right, const Ray& ray, float t) {
    return std::abs((t - right.t) * dot(ray.direction, right.geometric_normal)) <= right.position_error;
}

struct Comparison {
    int rays = 0, hits = 0, different = 0, shadows = 0;
    std::string first;
};

/// Rays at the box, from without and from within, by the wide tree and by asking every shape.
Comparison compare_with_brute(const Scene& scene, const Aabb& box, int count, std::uint64_t seed = 7) {
    Scene brute = scene, wide = scene;
    brute.accel = Accel::brute;
    wide.accel = Accel::wide;
    build_bvhs(wide);
    Comparison result;
    Random random(seed);
    const float size = std::max(length(box.max - box.min), 1e-20f);
    for (int i = 0; i < count; ++i) {
        const vec3 target = mix(box.min, box.max, random_point(random));
        vec3 origin = (box.min + box.max) / 2.0f + size * random_direction(random);
        if (i % 4 == 0) origin = mix(box.min, box.max, random_point(random));
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

void check_wide_changes_nothing(const Scene& scene, const Aabb& box, int count) {
    const Comparison result = compare_with_brute(scene, box, count);
    INFO(result.hits, " of ", result.rays, " rays hit");
    CHECK_MESSAGE(result.different == 0, result.first,
                  " (none: a box is too small, or NaN rejects it; too far: the search ended too soon)");
    CHECK_MESSAGE(result.shadows == 0, "any_hit() must agree with nearest()");
}

void check_wide_changes_nothing(const ObjModel& file, int count) {
    const Scene scene = prepared(file);
    check_wide_changes_nothing(scene, bounds(scene.mesh), count);
}

} // namespace

TEST_CASE("a ray that aims at an edge or a corner that triangles share never slips through, in float") {
    for (const float far : {1.0f, 30.0f, 3000.0f}) {
        const ObjModel files[] = {icosphere(3), flat_grid(24)};
        for (const ObjModel& file : files) {
            const Scene scene = prepared(file);
            Random random(82);
            int slipped = 0, shadows = 0;
            const int count = 4000;
            for (int i = 0; i < count; ++i) {
                const auto corner = vertices(
                    scene.mesh, std::uint32_t(random.uniform() * float(scene.mesh.triangles.size())));
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

TEST_CASE("the wide tree finds what asking every shape finds") {
    check_wide_changes_nothing(random_triangles(2000, 0.15f), 1200);
    check_wide_changes_nothing(flat_grid(20), 1500);
    check_wide_changes_nothing(icosphere(3), 1500);
    ObjModel far = random_triangles(300, 0.3f);
    transform(far, 50, vec3(1e4f, -1e4f, 1e4f));
    check_wide_changes_nothing(far, 2000);
    ObjModel small = random_triangles(300, 0.3f);
    transform(small, 1e-3f, vec3(0));
    check_wide_changes_nothing(small, 2000);
}

TEST_CASE("the wide tree finds what asking every shape finds, among identical, flat and huge triangles") {
    const vec3 a = {1, -2, 3}, b = {3, 1, 4}, c = {-1, 2, 6};
    ObjModel identical = empty_file();
    for (int i = 0; i < 100; ++i) add_triangle(identical, a, b, c);
    check_wide_changes_nothing(identical, 1000);
    ObjModel file = empty_file();
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
    const int grey = add(scene.materials, Diffuse{vec3(0.5f)});
    for (int i = 0; i < 500; ++i)
        scene.spheres.push_back({random_point(random), 0.08f * random.uniform() + 1e-3f, grey});
    check_wide_changes_nothing(scene, {vec3(0), vec3(1)}, 1500);
    scene.planes = {{{0, 0.3f, 0}, normalize(vec3(0.1f, 1, 0)), grey}};
    for (int i = 0; i < 40; ++i)
        scene.quads.push_back(
            {random_point(random), 0.3f * random_point(random), 0.3f * random_direction(random), grey});
    add_model(scene, random_triangles(500, 0.2f), 40);
    check_wide_changes_nothing(scene, {vec3(0), vec3(1)}, 2000);
}

TEST_CASE("a quad in the wide tree has the hit of a quad, in both of its halves") {
    Scene scene;
    add(scene.materials, Diffuse{vec3(0.5f)});
    const int second = add(scene.materials, Diffuse{vec3(0.7f)});
    scene.quads = {{{1, 0.5f, -2}, {2, 0.3f, 0.1f}, {-0.2f, 1.5f, 0.4f}, second}};
    build_bvhs(scene);
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
    ray_stats = {};
    const int rays = 3000;
    for (int i = 0; i < rays; ++i) {
        const vec3 from = 3.0f * random_point(random) - 1.0f, to = random_point(random);
        intersect(scene, Ray{from, to - from});
    }
    const double nodes = double(ray_stats.box_tests) / lanes / rays,
                 blocks = double(ray_stats.triangle_tests) / lanes / rays;
    INFO(nodes, " nodes and ", blocks, " blocks a ray");
    CHECK_MESSAGE(
        nodes < 64.0 / lanes,
        "more than twice that: nearer children do not come first, or boxes beyond a hit are entered");
    CHECK_MESSAGE(blocks < 8, "15: the same, or the cut is a bad one");
    CHECK(blocks > 0.5);
}
