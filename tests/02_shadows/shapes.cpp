// Facts about a scene: what a ray hits first, and whether anything occludes a segment.
#include "tests/check.h"

#include "02_shadows/scene.h"
#include "common/math/random.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "tests/02_shadows/step.h"
#include "tests/02_shadows/scenes.h"

using namespace rt;

TEST_CASE("a segment is occluded exactly if it hits something") {
    Random random(5);
    Scene scene;
    for (int i = 0; i < 30; ++i)
        scene.spheres.push_back({any_point(random, 3), 0.1f + 0.5f * random.get_1d(), i});
    scene.planes = {{{0, -2, 0}, normalize(vec3(1, 9, 2)), 30},
                    {{0, 0, -2.5f}, normalize(vec3(1, 2, 9)), 31}};
    int wrong = 0, hidden = 0;
    for (int i = 0; i < 10000; ++i) {
        const vec3 from = any_point(random, 3);
        const Ray ray{from, any_point(random, 3) - from, 0.2f * random.get_1d(), 0.2f + random.get_1d()};
        const bool meets = intersect(scene, ray).has_value();
        hidden += meets;
        wrong += occluded(scene, ray) != meets;
    }
    CHECK_MESSAGE(wrong == 0, wrong << " of 10000 segments are wrong");
    CHECK(hidden > 2000); // enough cases to check
    CHECK(hidden < 8000);
}

TEST_CASE("the shape that blocks a light may be anywhere in the list") {
    const Sphere left{{-9, 0, 0}, 1, 0}, hiding{{0, 2, 0}, 0.5f, 0}, right{{9, 0, 0}, 1, 0};
    const Ray up{{0, 0, 0}, {0, 4, 0}, 0, 1};
    for (const auto& spheres :
         {std::vector{hiding, left, right}, {left, hiding, right}, {left, right, hiding}}) {
        CHECK(occluded(lit_balls({}, spheres), up));
        CHECK_FALSE(occluded(lit_balls({}, spheres), Ray{up.origin, up.direction, 0, 0.3f}));
    }
    CHECK_FALSE(occluded(lit_balls({}, {left, right}), up));
    CHECK_FALSE(occluded(Scene{}, up));
    Scene walls;
    walls.planes = {{{0, -3, 0}, {0, 1, 0}, 0}, {{0, 3, 0}, {0, 1, 0}, 0}};
    CHECK(occluded(walls, up));
    CHECK_FALSE(occluded(walls, Ray{up.origin, up.direction, 0, 0.7f}));
}

TEST_CASE("of many shapes a ray hits the closest, whatever their order") {
    const vec3 origin(3, 1, -2), direction = 2.0f * vec3(2, -3, 6) / 7.0f;
    const auto ball = [&](int t) { return Sphere{origin + (float(t) + 0.25f) * direction, 0.5f, t}; };
    std::vector<int> order{2, 4, 5, 6};
    do {
        Scene scene;
        for (const int t : order) scene.spheres.push_back(ball(t));
        scene.planes = {{origin + 3.0f * direction, normalize(vec3(1, -1, 3)), 3}};
        for (const auto& [t_min, material] :
             {std::pair(0.0f, 2), {2.6f, 3}, {3.1f, 4}, {4.6f, 5}, {5.6f, 6}}) {
            const auto hit = intersect(scene, Ray{origin, direction, t_min});
            REQUIRE(hit);
            CHECK_MESSAGE(hit->material == material, "each material is the t at which the shape begins");
            CHECK(hit->t == approx(float(material)));
        }
        CHECK_FALSE(intersect(scene, Ray{origin, direction, 0, 1.9f}));
    } while (std::next_permutation(order.begin(), order.end()));
}
