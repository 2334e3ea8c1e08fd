// Facts about paths with a closed-form solution: furnaces, white worlds, skies and point lights.
// Statistical checks are z-tests with fixed seeds; a correct renderer exceeds |z| =
// 4 in one run out of 16,000.
#include "08_indirect/radiance.h"
#include "08_indirect/scene.h"
#include "tests/08_indirect/step.h"
#include "tests/08_indirect/paths.h"
#include "tests/check.h"

#include <array>
#include <cmath>
#include <variant>

using namespace rt;

namespace {

/// Builds a closed room: a ball of radius 2 with uniform emission and albedo. From inside, light sampling has
/// no noise, because cos cos' / r^2 is the same for all pairs of points.
Scene ball_room(vec3 albedo, vec3 emission) {
    Scene scene;
    scene.spheres = {{{1, -0.5f, 3}, 2, add(scene.materials, Diffuse{albedo, emission})}};
    build_bvhs(scene);
    return scene;
}

const Ray in_ball_room{{0.5f, 0.3f, 2.5f}, normalize(vec3(0.7f, 0.2f, -0.4f))};

} // namespace

TEST_CASE("a closed furnace has radiance Le (1 - rho^(k+1)) / (1 - rho) after k bounces") {
    // Without roulette there is no noise at all.
    const vec3 albedo(0.8f, 0.5f, 0.4f), emission(1, 1, 2.5f);
    const Scene scene = ball_room(albedo, emission);
    const AreaLights lights = collect_area_lights(scene);
    for (const DirectLighting direct : all_ways)
        for (const int depth : {0, 1, 2, 5, 60}) {
            const PathSettings settings{depth, true, direct, false};
            const vec3 want = emission * (1.0f - pow(albedo, vec3(float(depth + 1)))) / (1.0f - albedo);
            Random random(23);
            for (int i = 0; i < 30; ++i) {
                const vec3 got = radiance(scene, lights, settings, in_ball_room, random);
                INFO(words(settings) << ": expected " << to_text(want) << ", got " << to_text(got));
                INFO("0 at depth 0: emission of the first hit; 1.2 times too bright or more: light counted "
                     "twice; off by pi: 1 / pi; one bounce more or less: where the depth is counted");
                REQUIRE(got == approx(want, 2e-4f));
            }
            if (depth == 5) CHECK(want.x == approx(3.68928f));
            if (depth == 60) CHECK(want == approx(vec3(5, 2, 2.5f / 0.6f), 1e-4f));
        }
}

TEST_CASE("roulette keeps a furnace at Le / (1 - rho)") {
    const auto check = [](float rho, int depth, double want) {
        for (const DirectLighting direct : all_ways) {
            Scene scene = ball_room(vec3(rho), vec3(1));
            const PathSettings settings{depth, true, direct, true};
            const Mean mean = seen(scene, settings, in_ball_room);
            INFO("rho " << rho << ", " << words(settings) << ": " << mean.against(want)
                        << "; too dark: divide survivors by their probability");
            CHECK(off(mean, want) < 4);
        }
    };
    check(0.5f, 60, 2); // .8^61 is a millionth
    check(0.8f, 60, 5);
    check(0.8f, 5, 3.68928);
}

TEST_CASE("without indirect light a furnace has its own emission and one bounce") {
    const Scene scene = ball_room(vec3(0.8f, 0.5f, 0.4f), vec3(1, 2, 3));
    const AreaLights lights = collect_area_lights(scene);
    for (const DirectLighting direct : all_ways)
        for (const bool with_roulette : {false, true})
            for (const int depth : {0, 1, 7}) {
                const PathSettings settings{depth, false, direct, with_roulette};
                const vec3 want = vec3(1, 2, 3) * (depth == 0 ? vec3(1) : vec3(1.8f, 1.5f, 1.4f));
                Random random(29);
                const vec3 got = radiance(scene, lights, settings, in_ball_room, random);
                INFO(words(settings));
                CHECK(got == approx(want, 2e-4f));
            }
}

TEST_CASE("a white ball in a white world is invisible") {
    Scene scene;
    scene.sky = {vec3(0.5f, 1, 2), vec3(0.5f, 1, 2)};
    scene.spheres = {{{1, 2, -3}, 2, add(scene.materials, Diffuse{vec3(1)})}};
    build_bvhs(scene);
    Random random(31);
    for (int i = 0; i < 2000; ++i) {
        const vec3 aim =
            vec3(1, 2, -3) + 4.5f * (vec3(random.get_1d(), random.get_1d(), random.get_1d()) - 0.5f);
        const Ray ray{{4, -1, 5}, 2.0f * (aim - vec3(4, -1, 5))};
        const vec3 got = radiance(scene, AreaLights{}, {.depth = 1, .roulette = false}, ray, random);
        INFO("got " << to_text(got)
                    << "; off by pi or 1 / pi: the pi of Lambert's law; 2/3: the cosine is used twice");
        REQUIRE(got == approx(vec3(0.5f, 1, 2)));
    }
}

TEST_CASE("nothing white, mirroring or clear is visible in a white world") {
    Scene scene;
    scene.sky = {vec3(1), vec3(1)};
    const int white = add(scene.materials, Diffuse{vec3(1)});
    const int glass = add(scene.materials, Dielectric{{1.5f}});
    const int mirror = add(scene.materials, Mirror{});
    const int coat = add(scene.materials, Coated{0.4f, white});
    const int bubble = add(scene.materials, Dielectric{{1.0f}, {1.5f}});
    scene.planes = {{{0, 0, 0}, normalize(vec3(0.1f, 1, 0.2f)), white}};
    scene.spheres = {{{0, 2, 0}, 1, glass},
                     {{0.2f, 2.1f, 0.1f}, 0.4f, bubble},
                     {{2, 2, 0}, 0.9f, mirror},
                     {{-2, 2, 1}, 0.8f, coat}};
    scene.quads = {{{-3, 1, -3}, {6, 0.5f, 0}, {0, 4, 1}, white}};
    build_bvhs(scene);
    Random random(37);
    for (int i = 0; i < 4000; ++i) {
        const vec3 aim =
            6.0f * vec3(random.get_1d(), 0.1f + 0.6f * random.get_1d(), random.get_1d()) - vec3(3, 0, 3);
        const Ray ray{{0.5f, 3, 8}, aim - vec3(0.5f, 3, 8)};
        const vec3 got = radiance(scene, AreaLights{}, {.depth = 5000, .roulette = false}, ray, random);
        INFO("towards " << to_text(aim) << " came " << to_text(got)
                        << "; too dark: a random choice is weighted by its share and also picked with it");
        REQUIRE(got == approx(vec3(1), 1e-4f));
    }
}

TEST_CASE("under the sky L = cos theta the ground has the radiance 2 rho / 3") {
    Scene scene;
    scene.sky = {vec3(-1), vec3(1)}; // L = y
    scene.planes = {{{0, -1, 0}, {0, 1, 0}, add(scene.materials, Diffuse{vec3(0.6f)})}};
    for (const bool with_roulette : {false, true}) {
        const Mean mean = seen(scene, {.depth = 3, .roulette = with_roulette}, {{0, 1, 0}, {1, -1, 2}});
        INFO(mean.against(0.4) << "; .3 rho / .6: uniform directions with the pdf of cosine-weighted ones");
        CHECK(off(mean, 0.4) < 4);
    }
}

TEST_CASE("an oblique surface receives the light of the sky in front of it") {
    // E = pi mix(nadir, zenith, 1/2 + n.y / 3): a furnace tests energy, this tests direction.
    for (const vec3 normal : {normalize(vec3(1, 2, -2)), normalize(vec3(-0.4f, -0.2f, 0.7f)), vec3(0, 0, -1),
                              vec3(1, 0, 0), normalize(vec3(0.1f, -1, 0.1f))}) {
        Scene scene;
        scene.sky = {vec3(0.2f), vec3(3)};
        scene.planes = {{{1, 2, 3}, normal, add(scene.materials, Diffuse{vec3(0.7f)})}};
        const vec3 along = normalize(cross(normal, vec3(0.3f, 0.5f, 0.1f)));
        const Mean mean = seen(scene, {.depth = 2}, {vec3(1, 2, 3) + 2.0f * normal + along, -normal - along});
        const double want = 0.7 * (0.2 + (3 - 0.2) * (0.5 + double(normal.y) / 3));
        INFO("normal " << to_text(normal) << ": " << mean.against(want));
        CHECK(off(mean, want) < 4);
    }
}

TEST_CASE("a lamp has the radiance of its emission plus what it reflects") {
    Scene scene;
    scene.quads = {{{-1, -1, -4}, {2, 0, 0.5f}, {0, 2, 0}, add(scene.materials, emissive(vec3(17, 12, 7)))}};
    build_bvhs(scene);
    for (const DirectLighting direct : all_ways)
        for (const int depth : {0, 1, 5}) {
            Random random(41);
            const vec3 got = radiance(scene, collect_area_lights(scene), {.depth = depth, .direct = direct},
                                      {{0, 0, 0}, {0.1f, 0.1f, -1}}, random);
            CHECK_MESSAGE(got == approx(vec3(17, 12, 7)),
                          "black: emission must be added where the camera ray hits the lamp");
        }
}

TEST_CASE("point lights light the first surface as they do in step 02") {
    Scene scene;
    const int floor = add(scene.materials, Diffuse{{0.8f, 0.4f, 0.2f}});
    const int ball = add(scene.materials, Diffuse{{0.3f, 0.5f, 0.7f}});
    const int tiles = add(scene.materials, Checkerboard{vec3(0.7f), {0.2f, 0.1f, 0.3f}, 0.8f});
    scene.planes = {{{0, 0, 0}, normalize(vec3(0.1f, 1, 0.2f)), floor}, {{0, 0, -6}, {0, 0, 1}, tiles}};
    scene.spheres = {{{0, 1, 0}, 0.8f, ball}, {{2, 1.5f, -1}, 0.5f, ball}};
    scene.lights = {{{3, 4, 2}, {50, 40, 30}}, {{-4, 2, 1}, {5, 10, 20}}};
    build_bvhs(scene);
    Random random(43);
    for (int i = 0; i < 3000; ++i) {
        const vec3 aim =
            7.0f * (vec3(random.get_1d(), random.get_1d(), random.get_1d()) - vec3(0.5f, 0.3f, 0.8f));
        const Ray ray{{0, 3, 7}, aim - vec3(0, 3, 7)};
        const auto hit = intersect(scene, ray);
        vec3 want(0);
        if (hit) {
            const Material& material = scene.materials[std::size_t(hit->material)];
            const Diffuse* diffuse = std::get_if<Diffuse>(&material);
            want = shade_diffuse(scene, *hit,
                                 diffuse ? *diffuse : evaluate(std::get<Checkerboard>(material), hit->uv));
        }
        const vec3 got =
            radiance(scene, AreaLights{}, {.depth = 1, .direct = all_ways[std::size_t(i % 3)]}, ray, random);
        INFO("towards " << to_text(aim) << ": expected " << to_text(want) << ", got " << to_text(got));
        REQUIRE(got == approx(want));
    }
}

TEST_CASE("paths use the albedo of textures and checkerboards and the emission of textures") {
    // In a white world, a single flat object shows its albedo, whatever the direction of the bounce.
    Scene scene;
    scene.sky = {vec3(1), vec3(1)};
    const int picture =
        add(scene.textures, make_texture(Bitmap{1, 1, {65535, 32896, 13107}})); // 255, 128 and 51 of 255
    const int textured = add(scene.materials, ImageTexture{picture, vec3(0.5f), vec3(3, 0, 1)});
    const Checkerboard checkerboard{vec3(0.7f), {0.2f, 0.1f, 0.3f}, 0.8f};
    Scene tiled = scene;
    tiled.planes = {{{0, -2, 0}, {0, 1, 0}, add(tiled.materials, checkerboard)}};
    scene.quads = {{{-1, -1, -4}, {2, 0, 0.5f}, {0, 2, 0}, textured}};
    build_bvhs(scene);
    build_bvhs(tiled);
    Random random(47);
    for (int i = 0; i < 200; ++i) {
        const PathSettings settings{1 + i % 3, true, all_ways[std::size_t(i % 3)], false};
        const vec3 card =
            radiance(scene, collect_area_lights(scene), settings, {{0, 0, 0}, {0.1f, 0.1f, -1}}, random);
        REQUIRE(card == approx(vec3(3, 0, 1) + 0.5f * vec3(1, 0.2158605f, 0.0331048f)));
        // u is along x and v along -z, measured from the plane's point.
        const Ray down{{0, 0, 0}, {0.1f * float(i % 20), -1, 0.07f * float(i % 13)}};
        const vec3 tile = evaluate(checkerboard, {2 * down.direction.x, -2 * down.direction.z}).albedo;
        REQUIRE(radiance(tiled, AreaLights{}, settings, down, random) == approx(tile));
    }
}
