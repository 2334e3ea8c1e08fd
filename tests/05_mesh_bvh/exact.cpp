// Facts about the precision of hits.
// Hits are as exact as a float allows, for any size of shape and any acceleration structure, so that a
// secondary ray starts off the surface and on the correct side.
#include "02_shadows/spawn_ray.h"
#include "05_mesh_bvh/scene.h"
#include "common/math/random.h"
#include "tests/check.h"
#include "tests/meshes.h"

using namespace rt;

namespace {

float any_size(Random& random) {
    return std::pow(10.0f, 6 * random.get_1d() - 3); // from a millimetre to a kilometre
}

/// Builds triangles, quads and balls within a few metres, with sizes over six orders
/// of magnitude, and a plane.
Scene mixed_scene(std::uint64_t seed) {
    Random random(seed);
    ObjModel file = empty_file();
    for (int i = 0; i < 400; ++i) {
        const vec3 middle = 3.0f * random_direction(random);
        const float size = any_size(random);
        add_triangle(file, middle + size * random_direction(random), middle + size * random_direction(random),
                     middle + size * random_direction(random));
    }
    Scene scene;
    add_model(scene, file, 0);
    for (int i = 0; i < 20; ++i) {
        const float size = any_size(random);
        scene.quads.push_back({3.0f * random_direction(random) - size * vec3(0.3f, 0.5f, 0.1f),
                               size * random_direction(random), size * random_direction(random), 0});
        const float radius = any_size(random);
        scene.spheres.push_back({(radius + 2) * random_direction(random), radius, 0});
    }
    scene.planes = {{{500, -300, 20}, normalize(vec3(0.2f, 1, -0.3f)), 0}};
    return scene;
}

std::array<Scene, 3> by_all_ways(const Scene& scene) {
    std::array<Scene, 3> all{scene, scene, scene};
    for (std::size_t i = 0; i < 3; ++i) {
        all[i].accel = std::array{Accel::brute, Accel::bvh, Accel::wide}[i];
        build_bvhs(all[i]);
    }
    return all;
}

/// Returns the height of a point above the triangle's plane along its normal.
double height_over_triangle(const Mesh& mesh, std::uint32_t i, vec3 point) {
    const auto [a, b, c] = vertices(mesh, i);
    return dot(dvec3(point) - dvec3(a), normalize(area_normal({a, b, c})));
}

} // namespace

TEST_CASE("all acceleration structures agree on t among shapes of sizes over six orders of magnitude") {
    Random random(31);
    int hits = 0, lost = 0, off = 0, shadows = 0, count = 0;
    for (const std::uint64_t seed : {1, 2, 3}) {
        const auto [brute, bvh, wide] = by_all_ways(mixed_scene(seed));
        for (int i = 0; i < 4000; ++i, ++count) {
            Ray ray{4.0f * random_direction(random), random_direction(random)};
            if (i % 2 == 0) // from a surface, like bounces and shadow rays
                if (const auto hit = intersect(brute, ray)) ray = spawn_ray(*hit, random_direction(random));
            if (i % 3 == 0) ray.t_max = 2;
            const auto right = intersect(brute, ray);
            hits += right.has_value();
            for (const Scene* scene : {&bvh, &wide}) {
                const auto got = intersect(*scene, ray);
                lost += got.has_value() != right.has_value();
                if (got && right) off += std::abs(got->t - right->t) > 1e-6f * right->t;
                shadows += occluded(*scene, ray) != right.has_value();
            }
        }
    }
    INFO(hits, " of ", count, " rays hit");
    CHECK(hits > count / 3);
    CHECK_MESSAGE(lost <= 2,
                  "only at the very outline of a shape may one structure find a hit and another miss it");
    CHECK_MESSAGE(off <= 2, "only the exact test of the shape may decide where a ray hits it");
    CHECK(shadows <= 2);
}

TEST_CASE("a secondary ray starts off the surface on the correct side, whatever the triangle's size and the "
          "camera's distance") {
    Random random(32);
    double lowest = infinity, highest = 0;
    for (int i = 0; i < 20000; ++i) {
        ObjModel file = empty_file();
        const float size = any_size(random), away = any_size(random);
        const vec3 shift = any_size(random) * random_direction(random);
        const vec3 a = shift + size * random_direction(random), b = shift + size * random_direction(random),
                   c = shift + size * random_direction(random);
        add_triangle(file, a, b, c);
        const vec3 n = cross(normalize(b - a), normalize(c - a));
        if (length(n) < 0.05f) continue; // too thin
        Scene scene;
        append_model(scene.mesh, file, {0}, 0);
        scene.accel = i % 2 == 0 ? Accel::wide : Accel::brute;
        build_bvhs(scene);
        const vec3 target = 0.3f * a + 0.36f * b + 0.34f * c;
        const vec3 eye = target + away * normalize(random_direction(random));
        const auto hit = intersect(scene, Ray{eye, target - eye});
        if (!hit) continue; // the target is rounded, and the triangle may be seen edge-on
        for (const float side : {1.0f, -1.0f}) {
            const vec3 origin = offset_ray_origin(*hit, side * hit->geometric_normal);
            const double above = double(side) * height_over_triangle(scene.mesh, 0, origin) *
                                 (dot(hit->geometric_normal, n) > 0 ? 1 : -1) / double(hit->position_error);
            lowest = std::min(lowest, above);
            highest = std::max(highest, above);
        }
    }
    INFO("between ", lowest, " and ", highest, " times the error bound");
    CHECK_MESSAGE(lowest > 0, "the ray starts on the other side: shadow acne, or light leaks");
    CHECK_MESSAGE(highest < 2, "the ray starts too far from the surface: shadows detach");
}

TEST_CASE(
    "a floor of a metre or a kilometre casts no shadow on itself, and rays from it do not hit it again") {
    for (const float size : {1.0f, 30.0f, 1000.0f, 30000.0f}) {
        Random random(33);
        const vec3 up = normalize(vec3(0.3f, 1, -0.2f)), right = normalize(cross(up, vec3(0.1f, 0.2f, 1)));
        const vec3 forward = cross(right, up);
        ObjModel file = empty_file();
        const auto corner = [&](float x, float y) {
            return vec3(0.4f, -0.7f, 0.2f) + size * (x * right + y * forward);
        };
        add_triangle(file, corner(-1, -1), corner(1, 1), corner(1, -1));
        add_triangle(file, corner(-1, -1), corner(-1, 1), corner(1, 1));
        Scene scene;
        append_model(scene.mesh, file, {0}, 0);
        for (const Scene& found : by_all_ways(scene)) {
            int rays = 0, dark = 0, twice = 0;
            for (int i = 0; i < 3000; ++i) {
                const vec3 eye = vec3(0.4f, -0.7f, 0.2f) + 0.02f * random_direction(random) + 0.03f * up;
                const auto hit = intersect(found, Ray{eye, 0.02f * random_direction(random) - 0.03f * up});
                if (!hit) continue;
                ++rays;
                vec3 way = random_direction(random);
                if (dot(way, hit->geometric_normal) < 0) way = -way;
                if (i % 4 == 0)
                    way = normalize(way - 0.999f * dot(way, hit->geometric_normal) * hit->geometric_normal);
                dark += occluded(found, spawn_ray_to(*hit, hit->position + 5.0f * way));
                twice += intersect(found, spawn_ray(*hit, way)).has_value();
            }
            INFO("a floor of ", size, " m, accel ", int(found.accel), ", ", rays, " hits");
            CHECK(rays > 2000);
            CHECK_MESSAGE(dark == 0, "shadow acne");
            CHECK(twice == 0);
        }
    }
}

TEST_CASE("a surface hides what is behind it, whatever its shading normal") {
    const vec3 n = normalize(vec3(0.2f, 1, 0.1f)), bent = normalize(n + 0.8f * vec3(1, 0, 0));
    ObjModel file = empty_file();
    const vec3 u = normalize(cross(n, vec3(0, 0, 1))), v = cross(n, u);
    add_triangle(file, -4.0f * u - 4.0f * v, 4.0f * u - 4.0f * v, 6.0f * v);
    Scene scene;
    append_model(scene.mesh, file, {0}, 0);
    scene.mesh.normals.assign(scene.mesh.normals.size(), bent);
    for (const Scene& found : by_all_ways(scene)) {
        const auto hit = intersect(found, Ray{2.0f * n - u, -n});
        REQUIRE(hit);
        const vec3 behind = hit->position + 3.0f * normalize(u - 0.05f * n);
        CHECK(dot(behind - hit->position, hit->shading_normal) > 0);
        CHECK_MESSAGE(occluded(found, spawn_ray_to(*hit, behind)), "light leaks through the surface");
    }
}

TEST_CASE("a model of a picometre or a petametre has normals and is hit where it is") {
    for (const float size : {1e-12f, 1e-6f, 1.0f, 1e9f, 1e15f}) {
        ObjModel file = icosphere(2);
        transform(file, size, size * vec3(0.3f, -0.2f, 0.5f));
        Scene scene;
        add_model(scene, file, 60);
        for (const Scene& found : by_all_ways(scene)) {
            const vec3 center = size * vec3(0.3f, -0.2f, 0.5f), from = center + size * vec3(2, 3, -4);
            const auto hit = intersect(found, Ray{from, normalize(center - from)});
            INFO("size ", size, ", accel ", int(found.accel));
            REQUIRE(hit);
            CHECK(length(hit->shading_normal) == approx(1));
            CHECK(length(hit->geometric_normal) == approx(1));
            CHECK_MESSAGE(dot(hit->shading_normal, normalize(vec3(2, 3, -4))) == approx(1, 0.01f),
                          "must be smooth and point outward");
            CHECK(length((hit->position - center) / size) == approx(1, 0.02f));
        }
    }
}

TEST_CASE("models far from the origin are distinguished by double-precision coordinates") {
    ObjModel near = icosphere(1), far = icosphere(1);
    near.origin = {500000, 120, 4649776};
    far.origin = {500010.25, 118.5, 4649770};
    Scene scene;
    add_model(scene, near, 40);
    add_model(scene, far, 40);
    CHECK(scene.mesh.origin == near.origin);
    const Aabb box = bounds(scene.mesh);
    CHECK(box.min == approx({-1, -2.5f, -7}, 0.2f));
    CHECK_MESSAGE(box.max == approx({11.25f, 1, 1}, 0.2f),
                  "the second model must be shifted by the difference of the origins");
}
