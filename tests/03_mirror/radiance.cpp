// Facts about light among mirrors: what they show, and how many of them a ray may hit.
#include "03_mirror/radiance.h"
#include "tests/03_mirror/scenes.h"

using namespace rt;

TEST_CASE("a mirror of tint s under a sky of radiance c shows s c") {
    const vec3 s(0.5f, 0.9f, 0.2f);
    Scene scene = one_tile();
    add(scene.materials, Mirror{s});
    const vec3 seen = radiance(scene, to_tile, 5);
    CHECK_MESSAGE(seen == approx(s * c),
                  hint(seen, {{c, "the tint is missing"},
                              {s * s * c, "the tint was applied twice"},
                              {s, "the tint instead of tint times what the mirror shows"},
                              {vec3(0), "black: the recursion never starts, the reflected ray points inward, "
                                        "or it hits its own mirror"}}));
    CHECK_MESSAGE(radiance(scene, Ray{somewhere + slanting, -slanting}, 5) == approx(s * c),
                  "a mirror also reflects on its back");
}

TEST_CASE("a mirror shows the sky in the reflected direction") {
    Scene scene = one_tile();
    scene.sky = {{0.1f, 0.2f, 0.9f}, {0.7f, 0.4f, 0.1f}};
    add(scene.materials, Mirror{{0.5f, 0.9f, 0.2f}});
    const float d_n = dot(slanting, tilted);
    const vec3 r = slanting - 2 * d_n * tilted;
    const vec3 tint(0.5f, 0.9f, 0.2f), seen = radiance(scene, to_tile, 5);
    CHECK_MESSAGE(seen == approx(tint * radiance(scene.sky, r)),
                  hint(seen, {{tint * radiance(scene.sky, slanting), "the ray continued straight on"},
                              {tint * radiance(scene.sky, -r), "the reflected direction is negated"},
                              {tint * radiance(scene.sky, slanting + 2 * d_n * tilted),
                               "the reflection is upside down"}}));
}

TEST_CASE("each point of a mirror ball shows what is in the reflected direction") {
    // A target far away in that direction, and no other emitter.
    Random random(6);
    int found = 0;
    for (int i = 0; i < 200; ++i) {
        const Sphere ball{somewhere, 2, 0};
        const vec3 n = any_direction(random);
        const vec3 point = ball.center + ball.radius * n;
        const vec3 from = normalize(n + 0.9f * any_direction(random)); // points away from the ball
        const vec3 to = 2 * dot(from, n) * n - from; // the mirror image on the other side of n
        Scene scene;
        add(scene.materials, Mirror{{0.5f, 0.9f, 0.2f}});
        scene.spheres = {ball, {point + 9.0f * to, 0.1f, add(scene.materials, emissive({3, 2, 1}))}};
        found += radiance(scene, Ray{point + 3.0f * from, -2.0f * from}, 1) == approx(vec3(1.5f, 1.8f, 0.2f));
    }
    CHECK_MESSAGE(found == 200, found << " of 200 mirrored targets were seen");
}

TEST_CASE("eight facing mirrors of tint .9 show .43047 of the sky") {
    const Hall hall(8, {0.9f, 0.5f, 1});
    const vec3 seen = radiance(hall.scene, hall.ray, 20);
    const vec3 expected = vec3(0.43046721f, 0.00390625f, 1) * c;
    CHECK_MESSAGE(
        seen == approx(expected, 1e-6f),
        hint(seen, {{c, "the tint is missing"},
                    {vec3(0.9f, 0.5f, 1) * c, "the tint was applied only once"},
                    {vec3(0), "black: too few bounces, or a reflected ray was lost"},
                    {vec3(0.4782969f, 0.0078125f, 1) * c, "seven bounces: one is missing"},
                    {vec3(0.38742049f, 0.00195313f, 1) * c, "nine bounces: one was counted twice"}}));
}

TEST_CASE("k facing mirrors of tint s show s to the power of k") {
    for (int k = 1; k <= 30; ++k) {
        const Hall hall(k, {0.9f, 0.8f, 1});
        INFO(k << " bounces");
        CHECK(radiance(hall.scene, hall.ray, 40) ==
              approx(vec3(std::pow(0.9f, float(k)), std::pow(0.8f, float(k)), 1) * c));
    }
}

TEST_CASE("a ray may hit exactly as many mirrors as its depth, and is black after them") {
    for (const int k : {1, 2, 3, 8, 12}) {
        const Hall hall(k, {0.9f, 0.5f, 1});
        const vec3 whole = vec3(std::pow(0.9f, float(k)), std::pow(0.5f, float(k)), 1) * c;
        INFO(k << " mirrors on the path");
        CHECK_MESSAGE(radiance(hall.scene, hall.ray, k) == approx(whole),
                      "depth " << k << " is enough: one mirror too few was allowed");
        CHECK_MESSAGE(radiance(hall.scene, hall.ray, k + 1) == approx(whole),
                      "a greater depth must change nothing");
        CHECK_MESSAGE(radiance(hall.scene, hall.ray, k - 1) == vec3(0),
                      "depth " << k - 1 << " must not be enough: light beyond the last mirror is ignored");
    }
}

TEST_CASE("at depth 0 mirrors are black and everything else is unchanged") {
    Scene scene = one_tile();
    add(scene.materials, Mirror{vec3(1)});
    scene.quads.push_back(
        tile(somewhere + 9.0f * tilted, tilted, 1, add(scene.materials, emissive({3, 2, 1}))));
    CHECK(radiance(scene, to_tile, 0) == vec3(0));
    CHECK(radiance(scene, Ray{somewhere + 5.0f * tilted, 2.0f * tilted}, 0) == approx(vec3(3, 2, 1)));
    CHECK_MESSAGE(radiance(scene, Ray{somewhere + 5.0f * tilted, 2.0f * beside(tilted)}, 0) == approx(c),
                  "the sky is not a mirror");
}

TEST_CASE("the inside of a closed mirror without light is exactly dark") {
    // The sky outside is very bright: no ray may leak out.
    Random random(7);
    Scene shell{.sky = {vec3(1000), vec3(1000)}};
    shell.spheres = {{somewhere, 2, add(shell.materials, Mirror{vec3(1)})}};
    Scene box{.sky = {vec3(1000), vec3(1000)}};
    const int silver = add(box.materials, Mirror{vec3(1)});
    const vec3 a = tilted, b = beside(tilted);
    for (const vec3 axis : {a, b, cross(a, b)})
        for (const float side : {-1.0f, 1.0f})
            box.planes.push_back({somewhere + side * axis, side * axis, silver});
    int shell_leaks = 0, box_leaks = 0;
    for (int i = 0; i < 500; ++i) {
        const Ray ray{somewhere + any_point(random, 0.5f), 1.6f * any_direction(random)};
        shell_leaks += radiance(shell, ray, 60) != vec3(0);
        box_leaks += radiance(box, ray, 60) != vec3(0);
    }
    CHECK_MESSAGE(shell_leaks == 0, shell_leaks << " of 500 rays leaked out of the ball: the offset pointed "
                                                   "outward, or light was added after the last mirror");
    CHECK_MESSAGE(box_leaks == 0, box_leaks << " of 500 rays leaked out of the box");
}

TEST_CASE("inside a ball with a mirror for a wall, a lamp is seen by reflection from the wall") {
    Scene scene;
    const vec3 lamp = somewhere + vec3(0, 0.5f, 0);
    add(scene.materials, Mirror{{0.9f, 0.5f, 1}});
    scene.spheres = {{somewhere, 2, 0}, {lamp, 0.1f, add(scene.materials, emissive({3, 2, 1}))}};
    // One ray reaches the wall unobstructed, returns and hits the lamp from the other side.
    CHECK(radiance(scene, Ray{somewhere + vec3(0, 1, 0), {0, 2, 0}}, 5) == approx(vec3(2.7f, 1, 1)));
    CHECK(radiance(scene, Ray{somewhere, {0, -2, 0}}, 5) == approx(vec3(2.7f, 1, 1)));
}
