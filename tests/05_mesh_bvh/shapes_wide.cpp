// Facts about wide trees: they find the same hits as testing every shape, and count tests only on request.
#include "05_mesh_bvh/scene.h"
#include "common/math/random.h"
#include "tests/check.h"
#include "tests/meshes.h"

using namespace rt;

namespace {

/// Returns whether the point at t is within the error bound of the correct surface. A ray that
/// grazes a thin triangle may deviate along the surface, which is invisible, but perpendicular to it
/// the bound of hit.h must hold.
bool on_the_surface(const Hit& right, const Ray& ray, float t) {
    return std::abs((t - right.t) * dot(ray.direction, right.geometric_normal)) <= right.position_error;
}

struct Comparison {
    int rays = 0, hits = 0, different = 0, shadows = 0;
    std::string first;
};

/// Compares rays aimed at the box, from outside and from inside: by the wide tree and by testing every shape.
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
                  " (none: a box is too small, or NaN rejects it; too far: the search ended too early)");
    CHECK_MESSAGE(result.shadows == 0, "occluded() must agree with intersect()");
}

} // namespace

TEST_CASE("the wide tree finds spheres, quads and planes among triangles") {
    Random random(85);
    Scene scene;
    const int grey = add(scene.materials, Diffuse{vec3(0.5f)});
    for (int i = 0; i < 500; ++i)
        scene.spheres.push_back({random_point(random), 0.08f * random.get_1d() + 1e-3f, grey});
    check_wide_changes_nothing(scene, {vec3(0), vec3(1)}, 1500);
    scene.planes = {{{0, 0.3f, 0}, normalize(vec3(0.1f, 1, 0)), grey}};
    for (int i = 0; i < 40; ++i)
        scene.quads.push_back(
            {random_point(random), 0.3f * random_point(random), 0.3f * random_direction(random), grey});
    add_model(scene, random_triangles(500, 0.2f), 40);
    check_wide_changes_nothing(scene, {vec3(0), vec3(1)}, 2000);
}

TEST_CASE("a quad in the wide tree has the same hit as a quad in both of its halves") {
    Scene scene;
    add(scene.materials, Diffuse{vec3(0.5f)});
    const int second = add(scene.materials, Diffuse{vec3(0.7f)});
    scene.quads = {{{1, 0.5f, -2}, {2, 0.3f, 0.1f}, {-0.2f, 1.5f, 0.4f}, second}};
    build_bvhs(scene);
    Random random(86);
    for (int i = 0; i < 300; ++i) {
        const vec2 uv = 0.002f + 0.996f * random.get_2d();
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

TEST_CASE("the wide trees count their tests only for --view work") {
    Scene scene;
    add_model(scene, random_triangles(500, 0.2f), 40);
    scene.spheres = {{vec3(0.5f), 0.2f, 0}};
    build_bvhs(scene);
    const Ray ray{{0.5f, 0.5f, 3}, {0, 0, -1}};
    for (const bool counted : {false, true}) {
        scene.count_tests = counted;
        ray_stats = {};
        CHECK(intersect(scene, ray));
        CHECK(occluded(scene, ray));
        CHECK((ray_stats.box_tests > 0) == counted);
        CHECK((ray_stats.triangle_tests > 0) == counted);
    }
}
