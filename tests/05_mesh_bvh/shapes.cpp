// Facts about mixed shapes: a ray hits the closest of spheres, planes, quads and triangles.
#include "05_mesh_bvh/scene.h"
#include "tests/check.h"
#include "tests/meshes.h"

using namespace rt;

TEST_CASE("a ray hits the closest of several shapes, whatever its type") {
    for (int nearest = 0; nearest < 4; ++nearest) {
        const auto depth = [&](int kind) { return -2.0f - float((kind - nearest + 4) % 4); };
        for (const Accel accel : {Accel::brute, Accel::bvh, Accel::wide}) {
            Scene scene;
            scene.accel = accel;
            for (int kind = 0; kind < 3; ++kind) add(scene.materials, Diffuse{vec3(0.5f)});
            scene.spheres = {{{0, 0, depth(0) - 0.25f}, 0.25f, 0}};
            scene.planes = {{{0, 0, depth(1)}, {0, 0, 1}, 1}};
            scene.quads = {{{-1, -1, depth(2)}, {2, 0, 0}, {0, 2, 0}, 2}};
            ObjModel file = empty_file();
            add_triangle(file, {-3, -3, depth(3)}, {3, -3, depth(3)}, {0, 3, depth(3)});
            add_model(scene, file, 40);
            build_bvhs(scene);
            const auto hit = intersect(scene, Ray{{0.01f, 0.02f, 0}, {0, 0, -2}});
            REQUIRE(hit);
            INFO("closest of sphere, plane, quad, triangle: number ", nearest);
            CHECK_MESSAGE(hit->material == nearest, "each hit must shorten the ray for all later tests");
            CHECK(hit->t == approx(1, 1e-2f));
            CHECK(occluded(scene, Ray{{0.01f, 0.02f, 0}, {0, 0, -2}}));
            CHECK(!occluded(scene, Ray{{0.01f, 0.02f, 0}, {0, 0, -2}, 0, 0.98f}));
        }
    }
}
