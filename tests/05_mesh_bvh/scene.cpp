// Facts about the models in a scene: they keep their triangles and their materials.
#include "05_mesh_bvh/scene.h"
#include "tests/check.h"
#include "tests/meshes.h"

using namespace rt;

TEST_CASE("two models in one scene keep their own triangles and materials") {
    ObjModel one = empty_file(), two = empty_file();
    add_triangle(one, {-1, -1, 0}, {1, -1, 0}, {0, 1, 0});
    add_triangle(two, {-1, -1, 1}, {1, -1, 1}, {0, 1, 1});
    add_triangle(two, {-1, -1, 2}, {1, -1, 2}, {0, 1, 2});
    one.materials = {{.name = "red", .diffuse = {0.8f, 0.1f, 0.1f}}};
    two.materials = {{.name = "green", .diffuse = {0.1f, 0.8f, 0.1f}},
                     {.name = "lamp", .emission = {3, 2, 1}}};
    two.triangle_materials = {1, 0};
    Scene scene;
    add(scene.materials, emissive(vec3(7)));
    add_model(scene, one, 40);
    add_model(scene, two, 40);
    build_bvhs(scene);
    const auto hit_from = [&](vec3 from, float direction) {
        return *intersect(scene, Ray{from, {0, 0, direction}});
    };
    const auto diffuse = [&](const Hit& hit) {
        return std::get<Diffuse>(scene.materials[std::size_t(hit.material)]);
    };
    CHECK(diffuse(hit_from({0, 0, 3}, -1)).albedo == vec3(0.1f, 0.8f, 0.1f));
    CHECK(diffuse(hit_from({0, 0, 1.5f}, -1)).emission == vec3(3, 2, 1));
    CHECK(diffuse(hit_from({0, 0, -1}, 1)).albedo == vec3(0.8f, 0.1f, 0.1f));
}

TEST_CASE("a model's material becomes matte, coated or glass") {
    Scene scene;
    const auto added = [&](const ObjMaterial& material) {
        return scene.materials[std::size_t(add_material(scene, material))];
    };
    const Material matte = added({.diffuse = {0.8f, 0.4f, 0.2f}, .emission = {1, 2, 3}});
    REQUIRE(std::holds_alternative<Diffuse>(matte));
    CHECK(std::get<Diffuse>(matte).albedo == vec3(0.8f, 0.4f, 0.2f));
    CHECK(std::get<Diffuse>(matte).emission == vec3(1, 2, 3));
    const Material glazed = added({.diffuse = {0.8f, 0.4f, 0.2f}, .reflectivity = 0.3f});
    REQUIRE(std::holds_alternative<Coated>(glazed));
    CHECK(std::get<Coated>(glazed).reflectivity == 0.3f);
    CHECK(std::get<Diffuse>(scene.materials[std::size_t(std::get<Coated>(glazed).base)]).albedo ==
          vec3(0.8f, 0.4f, 0.2f));
    const Material clear = added({.ior = 1.33f, .glass = true});
    REQUIRE(std::holds_alternative<Dielectric>(clear));
    CHECK(std::get<Dielectric>(clear).interior.ior == 1.33f);
    CHECK(std::get<Dielectric>(clear).exterior.ior == 1);
}
