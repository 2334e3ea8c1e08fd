// Facts about a scene: the indices of its materials, and which shape a ray hits first.
#include "tests/check.h"

#include "01_spheres/scene.h"
#include "common/math/random.h"

#include <algorithm>
#include <vector>

#include "tests/01_spheres/step.h"

using namespace rt;

TEST_CASE("add returns the index of the material") {
    Scene scene;
    CHECK(add(scene.materials, Diffuse{vec3(0.1f)}) == 0);
    CHECK(add(scene.materials, Checkerboard{vec3(0.1f), vec3(0.2f)}) == 1);
    CHECK(add(scene.materials, emissive(vec3(1))) == 2);
    REQUIRE(scene.materials.size() == 3);
    CHECK(std::holds_alternative<Checkerboard>(scene.materials[1]));
}

TEST_CASE("in an empty scene a ray hits nothing") {
    CHECK_FALSE(intersect(Scene{}, Ray{{0, 0, 0}, {0, 0, -1}}));
}

TEST_CASE("of many shapes a ray hits the closest, whatever their order") {
    // Along the ray: a ball at t = 2, a plane at 3, balls at 4, 5 and 6. The material of each is its t.
    const vec3 origin(3, 1, -2);
    const vec3 direction = 2.0f * vec3(2, -3, 6) / 7.0f;
    const auto place = [&](float t) {
        return origin + (t + 0.25f) * direction;
    }; // the centre of a ball of radius .5
    std::vector<Sphere> balls{
        {place(2), 0.5f, 2}, {place(4), 0.5f, 4}, {place(5), 0.5f, 5}, {place(6), 0.5f, 6}};
    const Plane plane{origin + 3.0f * direction, normalize(vec3(1, -1, 3)), 3};
    std::vector<int> order{0, 1, 2, 3};
    do {
        Scene scene;
        for (const int i : order) scene.spheres.push_back(balls[std::size_t(i)]);
        scene.planes = {plane};
        const auto expect = [&](float t_min, float t_max, int material, float t) {
            const auto hit = intersect(scene, Ray{origin, direction, t_min, t_max});
            INFO("t in (" << t_min << ", " << t_max
                          << "), first ball in the list: " << scene.spheres[0].material);
            REQUIRE(hit);
            CHECK_MESSAGE(hit->material == material, "each material is the t at which the shape begins");
            CHECK(hit->t == approx(t));
            CHECK(hit->position == approx(origin + t * direction));
        };
        expect(0, infinity, 2, 2);
        expect(2.1f, infinity, 2, 2.5f); // its far side
        expect(2.6f, infinity, 3, 3);
        expect(3.1f, infinity, 4, 4);
        expect(3.1f, 4.9f, 4, 4);
        expect(5.9f, 8, 6, 6);
        CHECK_FALSE(intersect(scene, Ray{origin, direction, 0, 1.9f}));
        CHECK_FALSE(intersect(scene, Ray{origin, direction, 6.6f}));
        CHECK_FALSE(intersect(scene, Ray{origin, direction, 2.6f, 2.9f}));
        CHECK_FALSE_MESSAGE(intersect(scene, Ray{origin, -direction}), "all shapes are behind the ray");
    } while (std::next_permutation(order.begin(), order.end()));
}

TEST_CASE("a plane in front of a ball is hit first, and the other way round") {
    Scene scene;
    scene.planes = {{{0, 0, -6}, {0, 0, 1}, 1}, {{0, 0, -9}, {0, 0, 1}, 2}};
    scene.spheres = {{{0, 0, -5}, 0.5f, 3}, {{2, 0, -7.5f}, 0.5f, 4}};
    CHECK(intersect(scene, Ray{{0, 0, 0}, {0, 0, -3}})->material == 3);
    CHECK(intersect(scene, Ray{{2, 0, 0}, {0, 0, -3}})->material == 1);
    CHECK(intersect(scene, Ray{{2, 0, -6.5f}, {0, 0, -3}})->material == 4);
    CHECK(intersect(scene, Ray{{2, 0, -8.5f}, {0, 0, -3}})->material == 2);
    CHECK(intersect(scene, Ray{{2, 0, -8.5f}, {0, 0, 3}})->material == 4);
}

TEST_CASE("the closest of a hundred balls is the one with the smallest t") {
    Random random(6);
    Scene scene;
    for (int i = 0; i < 100; ++i)
        scene.spheres.push_back({any_point(random, 3), 0.1f + 0.6f * random.get_1d(), i});
    int wrong = 0, hits = 0;
    for (int i = 0; i < 3000; ++i) {
        const Ray ray{any_point(random, 3), (0.3f + 2 * random.get_1d()) * any_direction(random)};
        float smallest = infinity;
        int nearest = -1;
        for (const Sphere& sphere : scene.spheres)
            if (const auto t = intersect(sphere, ray); t && *t < smallest) {
                smallest = *t;
                nearest = sphere.material;
            }
        const auto hit = intersect(scene, ray);
        hits += nearest >= 0;
        wrong += (hit ? hit->material : -1) != nearest;
    }
    CHECK_MESSAGE(wrong == 0, wrong << " of 3000 rays hit the wrong ball; " << hits << " of them hit any");
    CHECK(hits > 1000);
}
