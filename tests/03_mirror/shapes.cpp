// Facts about a scene with quads: what a ray hits first, and what blocks a light.
#include "03_mirror/scene.h"
#include "tests/03_mirror/scenes.h"

#include <algorithm>
#include <utility>
#include <vector>

using namespace rt;

TEST_CASE("of balls, planes and quads a ray hits the closest, whatever their order") {
    const vec3 origin(3, 1, -2), direction = 2.0f * vec3(2, -3, 6) / 7.0f;
    const vec3 normal = normalize(vec3(1, -1, 3));
    const auto place = [&](int t) { return origin + float(t) * direction; };
    std::vector<int> order{1, 3, 6};
    do {
        Scene scene;
        for (const int t : order) {
            scene.quads.push_back(tile(place(t), normal, 1, t));
            scene.spheres.push_back({origin + (float(t) + 1.25f) * direction, 0.5f, t + 1});
        }
        scene.planes = {{place(5), normal, 5}};
        for (const auto& [t_min, t] :
             {std::pair(0.0f, 1), {1.1f, 2}, {2.6f, 3}, {3.1f, 4}, {4.6f, 5}, {5.1f, 6}}) {
            const auto hit = intersect(scene, Ray{origin, direction, t_min});
            REQUIRE(hit);
            CHECK_MESSAGE(hit->material == t, "each material is the t at which the shape begins");
            CHECK(hit->t == approx(float(t)));
        }
        CHECK_FALSE(intersect(scene, Ray{origin, direction, 0, 0.9f}));
    } while (std::next_permutation(order.begin(), order.end()));
}

TEST_CASE("a segment is occluded exactly if it hits something") {
    Random random(8);
    Scene scene;
    for (int i = 0; i < 20; ++i) {
        scene.spheres.push_back({any_point(random, 3), 0.1f + 0.5f * random.get_1d(), 0});
        scene.quads.push_back({any_point(random, 3), any_point(random, 1), any_point(random, 1), 0});
    }
    scene.planes = {{{0, -2, 0}, normalize(vec3(1, 9, 2)), 0}};
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
