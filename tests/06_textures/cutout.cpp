// Facts about cut-outs and vertex colours: a hole does not exist for camera rays, shadow rays and lamps.
#include "06_textures/cutout.h"
#include "04_refraction/radiance.h"
#include "06_textures/scene.h"
#include "common/math/random.h"
#include "tests/check.h"
#include "tests/meshes.h"

using namespace rt;

namespace {

/// Adds half of a 2 x 2 square in the plane y = height, with uv = (x, -z), and the mask of its material.
void add_leaf(ObjModel& file, float height, int material) {
    const int p = int(file.positions.size());
    file.positions.insert(file.positions.end(), {{0, height, 0}, {2, height, 0}, {0, height, -2}});
    file.uvs.insert(file.uvs.end(), {{0, 0}, {2, 0}, {0, 2}});
    file.triangles.push_back({{{p, p}, {p + 1, p + 1}, {p + 2, p + 2}}});
    file.triangle_materials.push_back(material);
}

/// Builds a floor without holes and two leaves above it. The mask is opaque in its left half (u < 1/2).
Scene leaves(Accel accel) {
    ObjModel file;
    file.materials = {{.name = "floor", .diffuse = vec3(0.5f)},
                      {.name = "leaf", .diffuse = vec3(0.9f), .mask = 0}};
    Mask mask{8, 8, {}};
    for (int i = 0; i < 64; ++i) mask.opacity.push_back(i % 8 < 4 ? 65535 : 0);
    file.masks = {mask};
    add_leaf(file, 0, 0);
    add_leaf(file, 1, 1);
    add_leaf(file, 2, 1);
    Scene scene;
    scene.accel = accel;
    add_model(scene, file, 40);
    build_bvhs(scene);
    return scene;
}

} // namespace

TEST_CASE("a ray passes through the holes of a surface and stops where the surface is opaque") {
    for (const Accel accel : {Accel::brute, Accel::bvh, Accel::wide}) {
        const Scene scene = leaves(accel);
        const auto opaque = intersect(scene, Ray{{0.25f, 5, -0.3f}, {0, -2, 0}});
        const auto hole = intersect(scene, Ray{{0.75f, 5, -0.3f}, {0, -2, 0}});
        REQUIRE(opaque);
        REQUIRE(hole);
        CHECK(opaque->t == approx(1.5f));
        CHECK_MESSAGE(hole->t == approx(2.5f),
                      "through both leaves to the floor; t is measured from the ray's origin");
        CHECK(hole->material == 0);
        CHECK_FALSE(intersect(scene, Ray{{0.75f, 5, -0.3f}, {0, -2, 0}, 0, 2.4f}));
        CHECK_FALSE_MESSAGE(intersect(scene, Ray{{0.75f, 0.5f, -0.3f}, {0, 2, 0}}), "from below, too");
    }
}

TEST_CASE("light passes through the holes of a surface") {
    for (const Accel accel : {Accel::brute, Accel::bvh, Accel::wide}) {
        const Scene scene = leaves(accel);
        CHECK(occluded(scene, Ray{{0.25f, 0.1f, -0.3f}, {0, 5, 0}, 0, 1}));
        CHECK_FALSE(occluded(scene, Ray{{0.75f, 0.1f, -0.3f}, {0, 5, 0}, 0, 1}));
        CHECK_MESSAGE(occluded(scene, Ray{{0.75f, 1.9f, -0.3f}, {0, -5, 0}, 0, 1}), "the floor has no holes");
    }
}

TEST_CASE("a mask with stripes of equal width is opaque in half of its area") {
    const Scene scene = leaves(Accel::wide);
    Random random(61);
    int there = 0;
    const int count = 20000;
    for (int i = 0; i < count; ++i) {
        const vec2 p = random.get_2d();
        const auto hit = intersect(scene, Ray{{p.x, 5, -p.y * (1 - 1e-3f)}, {0, -1, 0}});
        there += hit && hit->material == 1;
    }
    // Interpolation puts the outline halfway between an opaque texel and a hole.
    CHECK(float(there) / float(count) == approx(0.5f, 0.02f));
}

TEST_CASE("a mask is an opacity and not a colour") {
    const Texture texture = make_mask({2, 1, {32768, 65535}});
    CHECK_MESSAGE(texture.texels[0].x == approx(0.5f, 1e-4f), "0.216: the mask was decoded as sRGB");
    CHECK(texture.texels[1].x == 1);
}

TEST_CASE("an emissive surface has no holes") {
    ObjModel file;
    file.materials = {{.name = "lamp", .diffuse = vec3(0), .emission = vec3(2), .mask = 0}};
    file.masks = {{1, 1, {0}}};
    add_leaf(file, 1, 0);
    Scene scene;
    add_model(scene, file, 40);
    build_bvhs(scene);
    CHECK(intersect(scene, Ray{{0.5f, 5, -0.5f}, {0, -1, 0}}));
}

TEST_CASE("vertex colours are interpolated over a triangle and multiply its albedo") {
    ObjModel file = empty_file();
    file.materials[0].diffuse = vec3(0.5f);
    add_triangle(file, {0, 0, 0}, {0, 0, 3}, {3, 0, 0});
    file.colors = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    Scene scene;
    add_model(scene, icosphere(0), 40); // without colours, and therefore white
    for (vec3& position : scene.mesh.positions) position.y -= 10;
    add_model(scene, file, 40);
    scene.sky = {.nadir = vec3(1), .zenith = vec3(1)};
    build_bvhs(scene);
    const Ray ray{{0.9f, 2, 0.6f}, {0, -1, 0}};
    const auto hit = intersect(scene, ray);
    REQUIRE(hit);
    CHECK(hit->vertex_color == approx({0.5f, 0.2f, 0.3f}));
    CHECK(radiance(scene, ray, 1) == approx(0.5f * vec3(0.5f, 0.2f, 0.3f)));
    const auto white = intersect(scene, Ray{{5, -10, 0.1f}, {-1, 0, 0}});
    REQUIRE(white);
    CHECK(white->vertex_color == vec3(1));
}
