// Facts about coated surfaces: the shares of base and mirror, coats over coats, and recursion depth.
#include "03_mirror/radiance.h"
#include "tests/03_mirror/scenes.h"

using namespace rt;

TEST_CASE("a reflective surface blends its base with what it mirrors") {
    const vec3 tint(0.5f, 0.9f, 0.2f), glow(3, 0.3f, 1);
    for (const float reflectivity : {0.0f, 0.25f, 0.8f, 1.0f}) {
        Scene scene = one_tile();
        scene.quads[0].material = 1;
        add(scene.materials, emissive(glow));
        add(scene.materials, Coated{reflectivity, 0, tint});
        const vec3 seen = radiance(scene, to_tile, 5);
        INFO("reflectivity " << reflectivity);
        CHECK_MESSAGE(
            seen == approx((1 - reflectivity) * glow + reflectivity * tint * c),
            hint(seen, {{glow + reflectivity * tint * c, "the mirror is added on top of the whole base"},
                        {reflectivity * glow + (1 - reflectivity) * tint * c, "base and mirror swapped"},
                        {(1 - reflectivity) * glow + reflectivity * c, "the tint is missing"},
                        {reflectivity * tint * c, "the base is missing"},
                        {glow, "only the base"},
                        {tint * c, "only the mirror"}}));
    }
}

TEST_CASE("at reflectivity 0 a surface is its base, at 1 a mirror, to the last bit") {
    Scene scene = one_tile();
    scene.sky = {{0.1f, 0.2f, 0.9f}, {0.7f, 0.4f, 0.1f}};
    scene.lights = {{somewhere + 2.0f * tilted + beside(tilted), vec3(5, 4, 3)}};
    const vec3 tint(0.5f, 0.9f, 0.2f);
    const int matte = add(scene.materials, Diffuse{{0.8f, 0.4f, 0.6f}});
    const int mirror = add(scene.materials, Mirror{tint});
    const auto seen = [&](int material) {
        scene.quads[0].material = material;
        return radiance(scene, to_tile, 5);
    };
    CHECK(seen(add(scene.materials, Coated{0, matte, tint})) == seen(matte));
    CHECK(seen(add(scene.materials, Coated{1, matte, tint})) == seen(mirror));
}

TEST_CASE("the base of a reflective surface is lit and shadowed like any other") {
    Scene scene; // with a black sky, only the base's share is visible
    scene.quads = {tile(somewhere, tilted, 1, 1)};
    scene.lights = {{somewhere + 2.0f * tilted, vec3(pi)}};
    add(scene.materials, Diffuse{{0.8f, 0.4f, 0.5f}});
    add(scene.materials, Coated{0.25f, 0, vec3(1)});
    CHECK(radiance(scene, to_tile, 5) == approx(0.75f * vec3(0.2f, 0.1f, 0.125f)));
    scene.spheres = {{somewhere + 1.5f * tilted, 0.1f, 0}};
    CHECK(radiance(scene, to_tile, 5) == vec3(0));
}

TEST_CASE("a reflective checkerboard shows its squares through the mirror") {
    const vec3 even(0.8f, 0.2f, 0.1f), odd(0.1f, 0.4f, 0.3f), tint(0.5f, 0.9f, 0.2f);
    Scene scene{.sky = {c, c}};
    add(scene.materials, Checkerboard{even, odd, 0.5f});
    scene.planes = {{{0, 0, 0}, {0, 1, 0}, add(scene.materials, Coated{0.25f, 0, tint})}};
    const auto seen = [&](float x, float z) {
        const vec3 view(0.6f, -1, 0.4f);
        return radiance(scene, Ray{vec3(x, 0, z) - 2.0f * view, view}, 5);
    };
    CHECK(seen(0.2f, -0.3f) == approx(0.75f * even * c + 0.25f * tint * c));
    CHECK(seen(0.7f, -0.3f) == approx(0.75f * odd * c + 0.25f * tint * c));
    CHECK(seen(-0.2f, -0.3f) == approx(0.75f * odd * c + 0.25f * tint * c));
}

TEST_CASE("a reflective coat can cover a mirror") {
    const vec3 coat(0.5f, 0.9f, 0.2f), silver(1, 0.3f, 0.6f);
    for (const float reflectivity : {0.0f, 0.25f, 1.0f}) {
        Scene scene = one_tile();
        scene.quads[0].material = 1;
        add(scene.materials, Mirror{silver});
        add(scene.materials, Coated{reflectivity, 0, coat});
        INFO("reflectivity " << reflectivity);
        CHECK(radiance(scene, to_tile, 5) ==
              approx((1 - reflectivity) * silver * c + reflectivity * coat * c));
        CHECK_MESSAGE(radiance(scene, to_tile, 1) ==
                          approx((1 - reflectivity) * silver * c + reflectivity * coat * c),
                      "coat and mirror are one surface: a depth of 1 is enough for both");
        CHECK(radiance(scene, to_tile, 0) == vec3(0));
    }
}

TEST_CASE("a reflective coat can cover another coat") {
    const vec3 outer(0.5f, 0.9f, 0.2f), inner(1, 0.3f, 0.6f), glow(3, 0.3f, 1);
    Scene scene = one_tile();
    scene.quads[0].material = 2;
    add(scene.materials, emissive(glow));
    add(scene.materials, Coated{0.4f, 0, inner});
    add(scene.materials, Coated{0.25f, 1, outer});
    const vec3 base = 0.6f * glow + 0.4f * inner * c;
    CHECK(radiance(scene, to_tile, 5) == approx(0.75f * base + 0.25f * outer * c));
    CHECK_MESSAGE(radiance(scene, to_tile, 0) == approx(0.75f * 0.6f * glow), "the base needs no depth");
}

TEST_CASE("a reflective surface counts as a mirror, and its base costs no depth") {
    const vec3 glow(3, 0.3f, 1);
    Scene scene = one_tile();
    scene.quads[0].material = 1;
    add(scene.materials, emissive(glow));
    add(scene.materials, Coated{0.25f, 0, vec3(1)});
    CHECK_MESSAGE(radiance(scene, to_tile, 1) == approx(0.75f * glow + 0.25f * c), "one mirror on the path");
    CHECK_MESSAGE(radiance(scene, to_tile, 0) == approx(0.75f * glow),
                  "no mirror is allowed: the base remains and its share does not grow");
}

TEST_CASE("two lacquered walls show each other as often as the depth allows") {
    // Each wall shows .75 of its emission and .25 of the other wall: a geometric series.
    for (int depth = 0; depth <= 6; ++depth) {
        Hall hall(20, vec3(0));
        hall.scene.materials = {Coated{0.25f, 2, vec3(1)}, Coated{0.25f, 2, vec3(1)}, emissive({4, 8, 2})};
        INFO("depth " << depth);
        CHECK(radiance(hall.scene, hall.ray, depth) ==
              approx(vec3(4, 8, 2) * (1 - std::pow(0.25f, float(depth + 1)))));
    }
}

TEST_CASE("white objects are invisible under a uniform sky, whatever share of them is a mirror") {
    for (const float reflectivity : {0.0f, 0.25f, 0.5f, 1.0f}) {
        Scene scene{.sky = {c, c}};
        add(scene.materials, Diffuse{vec3(1)});
        add(scene.materials, Coated{reflectivity, 0, vec3(1)});
        scene.spheres = {{somewhere, 2, 1}};
        CHECK(radiance(scene, Ray{somewhere + vec3(4, 3, 5), {-0.7f, -0.5f, -1}}, 4) == approx(c));
    }
}
