// Facts about --view: what each view shows of a hit.
#include "tests/check.h"

#include "01_spheres/scene.h"
#include "01_spheres/program/options.h"

#include <vector>

#include "tests/01_spheres/ball.h"

using namespace rt;

namespace {
/// Builds two balls, one behind the other: `ball`, and a smaller one beyond it.
Scene two_balls() {
    Scene scene;
    scene.spheres = {{{1, -2, 3}, 2, 7}, {vec3(1, -2, 3) - 5.0f * outward, 1, 8}};
    return scene;
}
const Ray through_both{ball.center + 6.0f * outward, -2.0f * outward}; // hits `ball` after 4 metres
} // namespace

TEST_CASE("the normal view shows the normal as a colour") {
    CHECK(debug_colour(two_balls(), through_both, DebugView::normal, 1) == approx(0.5f + 0.5f * outward));
}

TEST_CASE("the depth view grows with the distance in metres and is mid grey at the given distance") {
    CHECK_MESSAGE(debug_colour(two_balls(), through_both, DebugView::depth, 4) == approx(vec3(0.5f)),
                  "the direction has length 2: t = 2 is 4 metres");
    CHECK(debug_colour(two_balls(), through_both, DebugView::depth, 12) == approx(vec3(0.25f)));
}

TEST_CASE("the uv view shows the surface coordinates") {
    const vec2 uv = sphere_uv(outward);
    CHECK(debug_colour(two_balls(), through_both, DebugView::uv, 1) == approx(vec3(uv, 0)));
    Scene floor;
    floor.planes = {{{0, 0, 0}, {0, 1, 0}, 0}};
    CHECK_MESSAGE(debug_colour(floor, Ray{{3.25f, 2, 4.5f}, {0, -1, 0}}, DebugView::uv, 1) ==
                      approx(vec3(0.25f, 0.5f, 0)),
                  "the uv view repeats every metre, on the negative side too");
}

TEST_CASE("the material view gives every material a colour of its own") {
    const vec3 near = debug_colour(two_balls(), through_both, DebugView::material, 1);
    CHECK(near == id_colour(7));
    std::vector<vec3> colours;
    for (int i = 0; i < 12; ++i) {
        const vec3 colour = id_colour(i);
        for (const float part : {colour.x, colour.y, colour.z}) CHECK((part >= 0 && part <= 1));
        for (const vec3 other : colours) CHECK(distance(colour, other) > 0.05f);
        colours.push_back(colour);
    }
}

TEST_CASE("the hits view counts the surfaces along the ray") {
    const auto hits = [](const Scene& scene, const Ray& ray) {
        return 8.0f * debug_colour(scene, ray, DebugView::depth_complexity, 1);
    };
    CHECK_MESSAGE(hits(two_balls(), through_both) == approx(vec3(4)),
                  "a ray enters and leaves each of the two balls");
    CHECK(hits(two_balls(), Ray{ball.center, -0.3f * outward}) == approx(vec3(3)));
    CHECK(hits(two_balls(), Ray{ball.center, outward}) == approx(vec3(1)));
    CHECK(hits(two_balls(), Ray{through_both.origin, -through_both.direction}) == approx(vec3(0)));
    Scene row;
    for (int i = 0; i < 9; ++i) row.spheres.push_back({{0, 0, -3.0f * float(i + 1)}, 1, 0});
    CHECK_MESSAGE(hits(row, Ray{{0, 0, 0}, {0, 0, -1}}) == approx(vec3(8)), "the view counts up to eight");
    CHECK(depth_complexity(row, Ray{{0, 0, 0}, {0, 0, -1}}, 100) == 18);
    CHECK(depth_complexity(row, Ray{{0, 0, 0}, {0, 0, -1}, 0, 6.5f}, 100) == 3);
}

TEST_CASE("the heat map runs from black through red and yellow to white") {
    CHECK(heat_map(0) == vec3(0));
    CHECK(heat_map(1.0f / 6) == approx(vec3(0.5f, 0, 0)));
    CHECK(heat_map(0.5f) == approx(vec3(1, 0.5f, 0)));
    CHECK(heat_map(0.9f) == approx(vec3(1, 1, 0.7f)));
    CHECK(heat_map(1.5f) == vec3(1));
}

TEST_CASE("a view is black where a ray hits nothing") {
    for (const DebugView view : {DebugView::normal, DebugView::depth, DebugView::uv, DebugView::material,
                                 DebugView::depth_complexity, DebugView::traversal_cost})
        CHECK(debug_colour(Scene{}, Ray{{0, 0, 0}, {0, 0, -1}}, view, 1) == vec3(0));
}

TEST_CASE("--view selects what is shown and radiance is the default") {
    const auto chosen = [](std::vector<const char*> words) {
        Options options("01_test", "What does a ray see first?", {});
        const auto view = view_option(options);
        words.insert(words.begin(), "01_test");
        options.parse(int(words.size()), words.data());
        return DebugView(view);
    };
    CHECK(chosen({}) == DebugView::radiance);
    CHECK(chosen({"--view", "normal"}) == DebugView::normal);
    CHECK(chosen({"--view", "depth"}) == DebugView::depth);
    CHECK(chosen({"--view", "uv"}) == DebugView::uv);
    CHECK(chosen({"--view", "material"}) == DebugView::material);
    CHECK(chosen({"--view", "hits"}) == DebugView::depth_complexity);
}
