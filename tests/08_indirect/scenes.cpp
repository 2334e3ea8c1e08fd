// Facts about the scenes that step 08 shares with other programs: positions, sizes, and published rules.
#include "08_indirect/program/cat_room.h"
#include "08_indirect/program/cornell.h"
#include "08_indirect/program/cover.h"
#include "08_indirect/radiance.h"
#include "08_indirect/program/weekend.h"
#include "tests/check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <variant>
#include <vector>

using namespace rt;

namespace {

/// Returns the volume enclosed by outward faces, by Gauss's theorem: the sum of
/// position . normal times area / 3.
double volume(std::span<const Quad> faces) {
    double sum = 0;
    for (const Quad& face : faces) sum += double(dot(face.corner, cross(face.edge_u, face.edge_v))) / 3;
    return sum;
}

bool has_corner(std::span<const Quad> faces, vec3 corner) {
    for (const Quad& face : faces)
        for (const vec2 uv : {vec2(0, 0), vec2(0, 1), vec2(1, 0), vec2(1, 1)})
            if (distance(face.corner + uv.x * face.edge_u + uv.y * face.edge_v, corner) < 0.01f) return true;
    return false;
}

vec3 albedo_of(const Scene& scene, const Quad& quad) {
    return std::get<Diffuse>(scene.materials[std::size_t(quad.material)]).albedo;
}

std::vector<Sphere> small_balls(const Scene& scene) {
    std::vector<Sphere> balls;
    for (const Sphere& sphere : scene.spheres)
        if (sphere.radius == 0.2f) balls.push_back(sphere);
    return balls;
}

} // namespace

TEST_CASE("a box is closed, faces outward and is rotated and translated correctly") {
    Scene scene;
    add_box(scene, {2, 3, 5}, 30, {10, 20, 30}, 7);
    REQUIRE(scene.quads.size() == 6);
    INFO("negative: it faces inward; a different size: a face is missing or duplicated");
    CHECK(float(volume(scene.quads)) == approx(30, 1e-4f));
    vec3 sum(0);
    float surface = 0;
    for (const Quad& face : scene.quads) {
        sum += cross(face.edge_u, face.edge_v);
        surface += area(face);
        CHECK(face.material == 7);
    }
    CHECK_MESSAGE(sum == approx(vec3(0), 1e-4f), "the area vectors of a closed surface must add up to zero");
    CHECK(surface == approx(62));
    // Rotated from +z towards +x: the far end of the z edge moves to (5 sin 30, 0, 5 cos 30).
    CHECK(has_corner(scene.quads, {10 + 2.5f, 20, 30 + 5 * std::sqrt(0.75f)}));
    CHECK(has_corner(scene.quads, {10 + 2 * std::sqrt(0.75f), 23, 30 - 1}));
}

TEST_CASE("the Cornell box has the published walls, lamp and boxes") {
    Scene scene;
    const LookAt look_at = cornell(scene);
    REQUIRE(scene.quads.size() == 18);
    CHECK(scene.sky.nadir == vec3(0));
    CHECK(scene.sky.zenith == vec3(0));
    CHECK(look_at.from == vec3(278, 278, -800));
    CHECK(look_at.at == vec3(278, 278, 0));
    CHECK(look_at.fov == 40);
    const std::span<const Quad> all(scene.quads);
    for (const Quad& wall : all.first(5)) CHECK(area(wall) == approx(555 * 555));
    const Quad& lamp = all[5];
    CHECK(area(lamp) == approx(130 * 105));
    CHECK(lamp.corner + (lamp.edge_u + lamp.edge_v) / 2.0f == approx(vec3(278, 554, 279.5f)));
    CHECK(emission(scene, lamp.material) == vec3(15));
    CHECK(float(volume(all.subspan(6, 6))) == approx(165 * 165 * 330, 1e-4f));
    CHECK(float(volume(all.subspan(12, 6))) == approx(165 * 165 * 165, 1e-4f));
    // Corners by the book's rotation and translation: cos 15 = .9659258, sin 15 = .2588190, cos 18 =
    // .9510565, sin 18 = .3090170.
    CHECK(has_corner(all.subspan(6, 6), {265 + 165 * 0.9659258f, 330, 295 - 165 * 0.2588190f}));
    CHECK(has_corner(all.subspan(6, 6), {265 + 165 * 0.2588190f, 0, 295 + 165 * 0.9659258f}));
    CHECK(has_corner(all.subspan(12, 6), {130 + 165 * 0.9510565f, 165, 65 + 165 * 0.3090170f}));
    CHECK(has_corner(all.subspan(12, 6), {130 - 165 * 0.3090170f, 0, 65 + 165 * 0.9510565f}));
}

TEST_CASE("the Cornell box is closed except for its front and green is on the left of its picture") {
    Scene scene;
    const LookAt look_at = cornell(scene);
    build_bvhs(scene);
    Random random(1);
    int through_the_front = 0;
    for (int i = 0; i < 20'000; ++i) {
        const Ray ray{{278, 450, 200}, sample_uniform_sphere(random.get_2d())};
        const float t = -ray.origin.z / ray.direction.z;
        const vec3 front = at(ray, t);
        const bool open = t > 0 && front.x > 0 && front.x < 555 && front.y > 0 && front.y < 555;
        through_the_front += open;
        const bool hit = intersect(scene, ray).has_value();
        INFO("towards " << to_text(ray.direction));
        REQUIRE_MESSAGE((hit || open), "light leaks out of the box");
        if (front.y > 340 && open)
            REQUIRE_MESSAGE(!hit, "nothing may be in the front opening above the boxes");
    }
    CHECK(through_the_front > 1000);
    const Camera camera = make_camera(look_at, 300, 300);
    const auto colour_at = [&](float x, float y) {
        const auto hit = intersect(scene, camera_ray(camera, {x, y}));
        REQUIRE(hit);
        return std::get<Diffuse>(scene.materials[std::size_t(hit->material)]).albedo;
    };
    CHECK(colour_at(15, 150) == vec3(0.12f, 0.45f, 0.15f));
    CHECK(colour_at(285, 150) == vec3(0.65f, 0.05f, 0.05f));
    CHECK(colour_at(150, 20) == vec3(0.73f));
    CHECK(colour_at(150, 290) == vec3(0.73f));
    for (const Quad& face : std::span(scene.quads).subspan(6)) CHECK(albedo_of(scene, face) == vec3(0.73f));
}

TEST_CASE("the weekend's balls follow the published rule") {
    Scene scene;
    const LookAt look_at = weekend(scene);
    CHECK(look_at.from == vec3(13, 2, 3));
    CHECK(look_at.fov == 20);
    CHECK(radiance(scene.sky, {0, 5, 0}) == approx(vec3(0.5f, 0.7f, 1)));
    CHECK(radiance(scene.sky, {3, 0, 1}) == approx(vec3(0.75f, 0.85f, 1)));
    CHECK_MESSAGE(weekend_lens.aperture_diameter == approx(2 * 10 * std::tan(glm::radians(0.3f)), 1e-5f),
                  "2 f tan(.6 / 2)");
    CHECK(weekend_lens.focus_distance == 10);
    const std::vector<Sphere> balls = small_balls(scene);
    REQUIRE(scene.spheres.size() == balls.size() + 4);
    CHECK_MESSAGE(balls.size() <= 22 * 22, "at most one per cell");
    CHECK_MESSAGE(balls.size() >= 22 * 22 - 6, "only cells around (4, .2, 0) may be empty");
    std::vector<int> cells;
    for (const Sphere& ball : balls) {
        const float x = std::floor(ball.center.x), z = std::floor(ball.center.z);
        INFO("at " << to_text(ball.center));
        REQUIRE((x >= -11 && x <= 10 && z >= -11 && z <= 10));
        REQUIRE(glm::max(ball.center.x - x, ball.center.z - z) <= 0.90001f);
        REQUIRE(ball.center.y == 0.2f);
        REQUIRE(distance(ball.center, vec3(4, 0.2f, 0)) > 0.9f);
        const int cell = int(22 * x + z);
        REQUIRE(std::ranges::find(cells, cell) == cells.end());
        cells.push_back(cell);
    }
    const auto count = [&](float radius, vec3 center) {
        return std::ranges::count_if(scene.spheres, [&](const Sphere& sphere) {
            return sphere.radius == radius && sphere.center == center;
        });
    };
    CHECK(count(1000, {0, -1000, 0}) == 1);
    for (const vec3 center : {vec3(0, 1, 0), vec3(-4, 1, 0), vec3(4, 1, 0)}) CHECK(count(1, center) == 1);
}

TEST_CASE("of the weekend's small balls 80 percent are matte, 15 metal and 5 glass, with the published "
          "distribution of colours") {
    // With 484 draws, a share deviates by more than four standard deviations in one run out of 16,000.
    Scene scene;
    weekend(scene);
    std::array<double, 3> found{};
    Mean albedo, tint, fuzz;
    for (const Sphere& ball : small_balls(scene)) {
        const Material& material = scene.materials[std::size_t(ball.material)];
        if (const Diffuse* diffuse = std::get_if<Diffuse>(&material)) {
            ++found[0];
            for (int k = 0; k < 3; ++k) albedo.add(double(diffuse->albedo[k]));
        } else if (const Metal* metal = std::get_if<Metal>(&material)) {
            ++found[1];
            REQUIRE((metal->fuzz >= 0 && metal->fuzz < 0.5f));
            fuzz.add(double(metal->fuzz));
            for (int k = 0; k < 3; ++k) {
                REQUIRE((metal->reflectance[k] >= 0.5f && metal->reflectance[k] <= 1));
                tint.add(double(metal->reflectance[k]));
            }
        } else {
            ++found[2];
            REQUIRE(std::get<Dielectric>(material).interior.ior == 1.5f);
        }
    }
    const double all = found[0] + found[1] + found[2];
    const std::array share{0.8, 0.15, 0.05};
    for (std::size_t k = 0; k < 3; ++k) {
        INFO("kind " << k << " (matte, metal, glass): " << found[k] << " of " << all);
        CHECK(std::abs(found[k] - share[k] * all) < 4 * std::sqrt(share[k] * (1 - share[k]) * all));
    }
    INFO("u times u: " << albedo.against(0.25) << "; .5: a single u");
    CHECK(std::abs(albedo.z(0.25)) < 4);
    INFO("tint of metal: " << tint.against(0.75) << ", fuzz " << fuzz.against(0.25));
    CHECK(std::abs(tint.z(0.75)) < 4);
    CHECK(std::abs(fuzz.z(0.25)) < 4);
}

TEST_CASE("a list of balls becomes a scene with the same balls") {
    Scene scene;
    const std::vector<SphereRecord> list{
        {SphereRecord::Kind::matte, {1, 2, 3}, 0.5f, {0.1f, 0.2f, 0.3f}},
        {SphereRecord::Kind::metal, {4, 5, 6}, 1.5f, {0.4f, 0.5f, 0.6f}, 0.25f},
        {.kind = SphereRecord::Kind::glass, .center = {7, 8, 9}, .radius = 2, .ior = 1.7f}};
    const LookAt look_at = weekend(scene, list);
    CHECK(look_at.from == vec3(13, 2, 3));
    REQUIRE(scene.spheres.size() == 3);
    const auto material = [&](std::size_t i) {
        return scene.materials[std::size_t(scene.spheres[i].material)];
    };
    for (std::size_t i = 0; i < 3; ++i) {
        CHECK(scene.spheres[i].center == list[i].center);
        CHECK(scene.spheres[i].radius == list[i].radius);
    }
    CHECK(std::get<Diffuse>(material(0)).albedo == vec3(0.1f, 0.2f, 0.3f));
    CHECK(std::get<Metal>(material(1)).reflectance == vec3(0.4f, 0.5f, 0.6f));
    CHECK(std::get<Metal>(material(1)).fuzz == 0.25f);
    CHECK(std::get<Dielectric>(material(2)).interior.ior == 1.7f);
}

TEST_CASE("the cat's room is closed and the cat is inside") {
    Scene scene;
    const LookAt look_at = cat_room(scene);
    build_bvhs(scene);
    CHECK(scene.mesh.triangles.size() >= 4000);
    const Aabb cat = bounds(scene.mesh);
    CHECK_MESSAGE(std::abs(cat.min.y) < 0.01f, "the cat must sit on the floor");
    Random random(2);
    for (int i = 0; i < 20'000; ++i) {
        const Ray ray{look_at.from, sample_uniform_sphere(random.get_2d())};
        INFO("towards " << to_text(ray.direction));
        REQUIRE_MESSAGE(intersect(scene, ray), "light leaks out of the room");
    }
}

TEST_CASE("what is on the cover's table stands on it and the cat is in focus") {
    Scene scene;
    const LookAt look_at = cover(scene);
    build_bvhs(scene);
    CHECK_MESSAGE(std::abs(bounds(scene.mesh).min.y) < 0.01f, "cat and teapot must stand on the table");
    for (const Sphere& ball : std::span(scene.spheres).first(5)) CHECK(ball.center.y == approx(ball.radius));
    const Camera camera = make_camera(look_at, 1280, 720);
    const auto hit = intersect(scene, camera_ray(camera, {550, 380}));
    REQUIRE(hit);
    const float depth = dot(hit->position - look_at.from, camera.forward);
    INFO("the cat's chest is " << depth << " m ahead");
    CHECK(std::abs(depth - distance(look_at.from, look_at.at)) < 0.3f);
    CHECK(collect_area_lights(scene).lights.size() == 2 + 3 * 15);
}
