// Facts about closed meshes, through which no ray slips, and about the normals that make them look smooth.
#include "05_mesh_bvh/scene.h"
#include "common/math/random.h"
#include "tests/05_mesh_bvh/step.h"
#include "tests/check.h"
#include "tests/meshes.h"

using namespace rt;

// ------------------------------------------------------------------------------------------- closed meshes

TEST_CASE("no ray aimed at a vertex or an edge of a closed mesh from inside gets out") {
    for (const float scale : {1.0f, 1e-3f, 1e4f}) {
        ObjModel file = icosphere(3);
        transform(file, scale, scale * vec3(0.3f, -0.2f, 0.1f));
        const Scene scene = scene_of(file);
        Random random(12);
        int slipped = 0;
        for (const auto& triangle : scene.mesh.triangles) {
            for (std::size_t k = 0; k < 3; ++k) {
                const vec3 p = scene.mesh.positions[triangle[k]],
                           q = scene.mesh.positions[triangle[(k + 1) % 3]];
                const vec3 from = scale * (vec3(0.3f, -0.2f, 0.1f) + 0.5f * (random_point(random) - 0.5f));
                for (const vec3 target : {p, (p + q) / 2.0f, mix(p, q, random.get_1d())})
                    slipped += !intersect(scene, Ray{from, target - from});
            }
        }
        INFO("scale ", scale);
        CHECK_MESSAGE(slipped == 0, "rays that slipped through, of 11,520");
    }
}

TEST_CASE("an icosphere of level 4 has nearly the area and the volume of the ball") {
    const Scene scene = scene_of(icosphere(4));
    double area = 0, volume = 0;
    for (std::uint32_t i = 0; i < scene.mesh.triangles.size(); ++i) {
        const auto corner = vertices(scene.mesh, i);
        area += length(area_normal(corner)) / 2;
        volume += double(dot(corner[0], cross(corner[1], corner[2]))) / 6;
        if (!(dot(area_normal(corner), dvec3(corner[0])) > 0)) FAIL_CHECK("triangle ", i, " faces inward");
    }
    CHECK(scene.mesh.triangles.size() == 5120);
    CHECK_MESSAGE(scene.mesh.positions.size() == 2562, "vertices are shared: V - E + F = 2");
    CHECK(std::abs(area / (4 * double(pi)) - 1) < 0.004);
    CHECK(std::abs(volume / (4 * double(pi) / 3) - 1) < 0.004);
}

TEST_CASE("a line crosses a closed mesh an even number of times alternately inward and outward") {
    const Scene scene = scene_of(icosphere(3));
    Random random(61);
    int odd = 0, wrong_side = 0, missed = 0;
    for (int i = 0; i < 2000; ++i) {
        const vec3 outside = 3.0f * normalize(random_direction(random));
        const vec3 target = random_point(random) - 0.5f;
        Ray ray{outside, target - outside};
        int crossings = 0;
        while (crossings < 20) {
            const auto hit = intersect(scene, ray);
            if (!hit) break;
            wrong_side += hit->back_face != (crossings % 2 == 1);
            ray.t_min = hit->t + hit->position_error / length(ray.direction);
            ++crossings;
        }
        odd += crossings % 2;
        missed += crossings == 0;
        const Ray from_inside{target, random_direction(random)};
        const auto from_within = intersect(scene, from_inside);
        wrong_side += !from_within || !from_within->back_face;
    }
    CHECK(odd == 0);
    CHECK(missed == 0);
    CHECK(wrong_side == 0);
}

// ------------------------------------------------------------------------------------------------- normals

TEST_CASE("a ball without normals becomes smooth and a cube without normals keeps its edges") {
    const Scene ball = scene_of(icosphere(3)), box = scene_of(cube());
    Random random(62);
    for (int i = 0; i < 500; ++i) {
        const vec3 direction = random_direction(random);
        const auto round = intersect(ball, Ray{-3.0f * direction / length(direction), direction});
        REQUIRE(round);
        if (!(dot(round->shading_normal, normalize(round->position)) > 0.999f))
            FAIL_CHECK("ball: at ", round->position, " the normal is ", round->shading_normal);
        const auto edged = intersect(box, Ray{-5.0f * direction / length(direction), direction});
        REQUIRE(edged);
        if (!(dot(edged->shading_normal, edged->geometric_normal) > 0.9999f))
            FAIL_CHECK("cube: at ", edged->position, " the normal is ", edged->shading_normal);
    }
}

TEST_CASE("an edge is smoothed if its angle is below the crease angle") {
    // Two squares that share an edge on the y axis, one bent down by 30 degrees.
    ObjModel file = empty_file();
    const vec3 down{std::cos(glm::radians(30.0f)), 0, -std::sin(glm::radians(30.0f))};
    add_triangle(file, {-1, 0, 0}, {0, 0, 0}, {0, 1, 0});
    add_triangle(file, {0, 0, 0}, down, {0, 1, 0});
    const auto normal_at_edge = [&](float crease) {
        const auto hit = intersect(scene_of(file, crease), Ray{{-0.0005f, 0.3f, 2}, {0, 0, -1}});
        REQUIRE(hit);
        return glm::degrees(std::asin(hit->shading_normal.x));
    };
    CHECK_MESSAGE(normal_at_edge(40) == approx(15, 1e-2f), "halfway between the two; 0: not smoothed");
    CHECK_MESSAGE(normal_at_edge(31) == approx(15, 1e-2f),
                  "the crease angle is in degrees, between the two faces' normals");
    CHECK_MESSAGE(normal_at_edge(29) == approx(0, 1e-4f), "30 degrees is sharper than 29");
    CHECK_MESSAGE(normal_at_edge(0) == approx(0, 1e-4f), "0: no smoothing at all");
}

TEST_CASE("normals in the file are kept and missing ones are computed") {
    ObjModel file = empty_file();
    add_triangle(file, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    file.normals = {vec3(3, 0, 4)};
    file.triangles[0][1].normal = 0;
    const Scene scene = scene_of(file);
    const auto& corner = scene.mesh.triangles[0];
    CHECK(scene.mesh.normals[corner[0]] == approx({0, 0, 1}));
    CHECK_MESSAGE(scene.mesh.normals[corner[1]] == approx({0.6f, 0, 0.8f}), "must be normalised");
    CHECK(scene.mesh.normals[corner[2]] == approx({0, 0, 1}));
}

TEST_CASE("a mirror on a smoothed mesh never sends a ray into the mesh") {
    const Scene scene =
        scene_of(icosphere(1), 180); // coarse, so that shading and geometric normals differ greatly
    Random random(64);
    int into = 0;
    for (int i = 0; i < 5000; ++i) {
        const vec3 from = 3.0f * normalize(random_direction(random));
        const Ray ray{from, 0.9f * normalize(random_direction(random)) - from};
        const auto hit = intersect(scene, ray);
        if (!hit) continue;
        into += !(dot(reflected_ray(ray, *hit).direction, hit->geometric_normal) > 0);
        into += !(dot(ray.direction, hit->shading_normal) < 0);
    }
    CHECK(into == 0);
}

TEST_CASE("the normal of a hit does not depend on the length of the ray's direction") {
    const Scene scene = scene_of(icosphere(1), 180);
    Random random(65);
    int different = 0;
    for (int i = 0; i < 2000; ++i) {
        const vec3 from = 3.0f * normalize(random_direction(random));
        const vec3 rim = normalize(cross(from, random_direction(random))); // rays that graze the ball
        const vec3 way = (0.8f + 0.2f * random.get_1d()) * rim - from;
        const auto slow = intersect(scene, Ray{from, way}), fast = intersect(scene, Ray{from, 8.0f * way});
        if (!slow || !fast) continue;
        different += !(slow->shading_normal == approx(fast->shading_normal, 1e-3f));
    }
    CHECK(different == 0);
}
