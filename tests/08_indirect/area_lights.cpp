// Facts about area lights: the irradiance that they cause, whatever their shape, number and occlusion.
// Statistical checks are z-tests with fixed seeds; a correct renderer exceeds |z| =
// 4 in one run out of 16,000.
#include "08_indirect/area_lights.h"
#include "08_indirect/scene.h"
#include "tests/08_indirect/step.h"
#include "tests/08_indirect/lamps.h"
#include "tests/check.h"

#include <array>
#include <cmath>
#include <functional>
#include <vector>

using namespace rt;
using glm::dvec3;

TEST_CASE("every emissive shape is a light and is picked in proportion to its power") {
    Scene scene;
    const int grey = add(scene.materials, Diffuse{vec3(0.5f)});
    const int red = add(scene.materials, Diffuse{vec3(0.5f), vec3(2, 0, 0)});
    const int white = add(scene.materials, emissive(vec3(3)));
    const int coat = add(scene.materials, Coated{0.25f, white});
    const int picture =
        add(scene.materials, ImageTexture{add(scene.textures, make_texture(Bitmap{1, 1, {9000, 9000, 9000}})),
                                          vec3(1), vec3(5)});
    scene.quads = {{{0, 0, 0}, {2, 0, 0}, {0, 0, 3}, red},
                   {{0, 5, 0}, {2, 0, 0}, {0, 0, 3}, grey},
                   {{0, 9, 0}, {1, 0, 0}, {0, 0, 2}, picture}};
    scene.spheres = {{{5, 0, 0}, 0.5f, white}, {{9, 0, 0}, 2, grey}};
    add_triangle(scene, {0, 0, 9}, {4, 0, 9}, {0, 1, 9}, coat);
    build_bvhs(scene);
    const AreaLights lights = collect_area_lights(scene);
    REQUIRE(lights.lights.size() == 4);
    REQUIRE(lights.cdf.size() == 4);
    const std::array power{0.2126f * 2 * 6, 5.0f * 2, 3.0f * pi, 0.75f * 3.0f * 2};
    float sum = 0, all = 0;
    for (const float one : power) all += one;
    for (std::size_t i = 0; i < power.size(); ++i) {
        sum += power[i];
        INFO("light " << i
                      << ": luminance of the emission times area; a coat of reflectivity k transmits 1 - k");
        CHECK(lights.cdf[i] == approx(sum / all));
    }
}

TEST_CASE("a disc above a point that faces it causes pi L R^2 / (R^2 + h^2)") {
    // R = .5, h = 1: a form factor of .2. The disc is a fan of 360 triangles with the area of the circle.
    Scene scene;
    const int lamp = add(scene.materials, emissive(vec3(3)));
    const int sides = 360;
    const double circle = std::sqrt(0.25 * double(pi) / (sides / 2.0 * std::sin(2 * double(pi) / sides)));
    const auto rim = [&](int i) {
        const double angle = 2 * double(pi) * i / sides;
        return vec3(2 + circle * std::cos(angle), 1, -3 + circle * std::sin(angle));
    };
    for (int i = 0; i < sides; ++i) add_triangle(scene, {2, 1, -3}, rim(i), rim(i + 1), lamp);
    const Mean mean = received(scene, {2, 0, -3}, {0, 1, 0}, 100'000);
    INFO("form factor times 3: " << mean.against(0.6));
    INFO(".25 * 3: the solid angle is approximated by pi R^2 / h^2, without the cosine of the light or the "
         "surface");
    CHECK(off(mean, 0.6) < 4);
}

TEST_CASE("a point below the centre of a unit square has a form factor of .2394565") {
    Scene scene;
    scene.quads = {{{-0.5f, 2, 3.5f}, {1, 0, 0}, {0, 0, 1}, add(scene.materials, emissive(vec3(1)))}};
    REQUIRE(float(form_factor(corners_of(scene.quads[0]), {0, 1, 4}, {0, 1, 0})) ==
            approx(0.2394565f, 1e-6f));
    const Mean mean = received(scene, {0, 1, 4}, {0, 1, 0}, 100'000);
    INFO(mean.against(0.2394565));
    CHECK(off(mean, 0.2394565) < 4);
}

TEST_CASE("an emissive parallelogram causes the irradiance of Lambert's polygon formula") {
    Scene scene;
    scene.quads = {
        {{1, 2, -1}, {2, 0.5f, 0.3f}, {0.9f, 1, 1.5f}, add(scene.materials, emissive(vec3(2.5f)))}};
    const vec3 position(0.2f, -0.3f, 0.7f), normal = normalize(vec3(0.8f, 0.9f, 0.1f));
    const double want = 2.5 * form_factor(corners_of(scene.quads[0]), position, normal);
    const Mean mean = received(scene, position, normal, 50'000);
    INFO(mean.against(want));
    INFO("off by a constant: the area, or 1 / pi; off by position: a cosine or 1 / r^2");
    CHECK(off(mean, want) < 4);
}

TEST_CASE("an emissive triangle causes the irradiance of Lambert's polygon formula from near and far") {
    const std::vector<vec3> triangle{{1, 0.4f, 2}, {3, 0.5f, 1}, {0.5f, 2, -1}};
    const vec3 normal = normalize(vec3(0.6f, 0.7f, 0.3f));
    for (const vec3 position : {vec3(0, 0, 0), vec3(-1, -3, -2), vec3(1.2f, 0.3f, 0.6f) - 0.5f * normal}) {
        Scene scene;
        const int lamp = add(scene.materials, emissive(vec3(4)));
        add_triangle(scene, triangle[0], triangle[1], triangle[2], lamp);
        const double want = 4 * form_factor(triangle, position, normal);
        const Mean mean = received(scene, position, normal, 50'000);
        INFO("from " << to_text(position) << ": " << mean.against(want));
        CHECK(off(mean, want) < 4);
    }
}

TEST_CASE("an emissive ball causes pi L (R / D)^2 times the cosine") {
    Scene scene;
    scene.spheres = {{{2, 3, -1}, 0.8f, add(scene.materials, emissive(vec3(6)))}};
    const vec3 position(0.5f, 0.2f, 0.3f);
    const vec3 normal = normalize(vec3(0.5f, 0.4f, 0.6f));
    const vec3 way = vec3(2, 3, -1) - position;
    const double want = 6 * 0.64 / double(dot(way, way)) * double(dot(normalize(way), normal));
    const Mean mean = received(scene, position, normal, 100'000);
    INFO(mean.against(want) << "; twice as much: the half that faces away must not contribute");
    CHECK(off(mean, want) < 4);
}

TEST_CASE("a light emits to both sides and adds nothing to surfaces that face away from it") {
    const Quad quad{{-1, 2, -0.5f}, {1.5f, 0.2f, 0}, {0.1f, 0, 2}, 0};
    const vec3 below(0.3f, 0.5f, 0.1f), above(0.3f, 3.5f, 0.1f);
    for (const bool under : {true, false}) {
        Scene scene;
        add(scene.materials, emissive(vec3(2)));
        scene.quads = {quad};
        const vec3 position = under ? below : above;
        const vec3 normal = normalize(vec3(0.2f, under ? 1.0f : -1.0f, 0.1f));
        const double want = 2 * form_factor(corners_of(quad), position, normal);
        const Mean mean = received(scene, position, normal);
        INFO(std::string(under ? "below: " : "above: ") << mean.against(want));
        CHECK(off(mean, want) < 4);
        CHECK_MESSAGE(received(scene, position, -normal, 1000).mean() == 0,
                      "a negative cosine must count as zero");
    }
}

TEST_CASE("several lights of different types and powers add up") {
    Scene scene;
    scene.quads = {
        {{1, 2, -1}, {2, 0.5f, 0.3f}, {0.9f, 1, 1.5f}, add(scene.materials, emissive(vec3(0.5f, 9, 9)))}};
    scene.spheres = {{{-2, 3, -1}, 0.8f, add(scene.materials, emissive(vec3(6, 0, 1)))}};
    const std::vector<vec3> triangle{{-1, 4, 2}, {1, 4.5f, 1}, {0.5f, 5, 3}};
    add_triangle(scene, triangle[0], triangle[1], triangle[2],
                 add(scene.materials, emissive(vec3(20, 1, 1))));
    const vec3 position(0.2f, -0.3f, 0.7f), normal = normalize(vec3(0.1f, 0.95f, -0.1f));
    const vec3 way = scene.spheres[0].center - position;
    const double want = 0.5 * form_factor(corners_of(scene.quads[0]), position, normal) +
                        6 * 0.64 / double(dot(way, way)) * double(dot(normalize(way), normal)) +
                        20 * form_factor(triangle, position, normal);
    const Mean mean = received(scene, position, normal, 100'000);
    INFO(mean.against(want)
         << "; a third or three times as much: divide by the probability of the picked light");
    CHECK(off(mean, want) < 4);
}

TEST_CASE("an occluder in front of a light darkens and one behind it does not") {
    const Quad lamp{{-0.5f, 2, -0.5f}, {1, 0, 0}, {0, 0, 1}, 0};
    const vec3 position(0.1f, 0, 0.2f), up(0, 1, 0);
    const double open = 3 * form_factor(corners_of(lamp), position, up);
    const auto with = [&](const std::function<void(Scene&)>& change) {
        Scene scene;
        add(scene.materials, emissive(vec3(3)));
        add(scene.materials, Diffuse{vec3(0.5f)});
        scene.quads = {lamp};
        change(scene);
        return received(scene, position, up);
    };
    const Mean hidden = with([](Scene& s) { s.quads.push_back({{-3, 1, -3}, {6, 0, 0}, {0, 0, 6}, 1}); });
    INFO("light passes through a board: area lights must cast shadows too");
    CHECK(hidden.mean() == 0);
    const Mean ceiling = with([](Scene& s) {
        s.quads.push_back({{-3, 2.002f, -3}, {6, 0, 0}, {0, 0, 6}, 1});
    });
    INFO("a ceiling 2 mm above the lamp: " << ceiling.against(open)
                                           << "; the shadow ray must end at the lamp");
    CHECK(off(ceiling, open) < 4);
    // The edge of a board above the point hides the half x > .1 of the lamp.
    const Mean half = with([](Scene& s) { s.quads.push_back({{0.1f, 1, -3}, {6, 0, 0}, {0, 0, 6}, 1}); });
    const double left =
        3 *
        form_factor({{-0.5f, 2, -0.5f}, {0.1f, 2, -0.5f}, {0.1f, 2, 0.5f}, {-0.5f, 2, 0.5f}}, position, up);
    INFO("half hidden: " << half.against(left));
    CHECK(off(half, left) < 4);
}

TEST_CASE("a point of a lamp gets no light from that very point and none from the lamp's plane") {
    struct Corner { // selects the quad's corner
        float get_1d() { return 0; }
        vec2 get_2d() { return vec2(0); }
    } corner;
    Scene scene;
    scene.quads = {{{1, 2, 3}, {1, 0, 0}, {0, 0, 1}, add(scene.materials, emissive(vec3(5)))}};
    build_bvhs(scene);
    const AreaLights lights = collect_area_lights(scene);
    for (const auto& against : {std::optional<HemisphereSampling>(), {HemisphereSampling::cosine}}) {
        const auto from = [&](vec3 position, vec3 normal) {
            return sample_area_lights(scene, lights, facing(position, normal), corner, vec3(0), against);
        };
        CHECK_MESSAGE(from({1, 2, 3}, {0, 1, 0}) == vec3(0),
                      "NaN: 0 / 0 is the cosine there, and NaN <= 0 is false; write !(cosine > 0)");
        CHECK(from({-1, 2, 3}, {1, 0, 0}) == vec3(0));
    }
}

TEST_CASE("a scene without area lights gets no light from them") {
    Scene scene;
    scene.spheres = {{{0, 3, 0}, 1, add(scene.materials, Diffuse{vec3(0.5f)})}};
    CHECK(received(scene, {0, 0, 0}, {0, 1, 0}, 100).mean() == 0);
}

TEST_CASE("the pdf of a direction towards lights is that with which they are sampled") {
    // The mean of 1 / p(w) over sampled points is the solid angle of the lights, front and back.
    Scene scene;
    scene.quads = {
        {{1, 2, -1}, {2, 0.5f, 0.3f}, {0.9f, 1, 1.5f}, add(scene.materials, emissive(vec3(0.5f, 9, 9)))}};
    scene.spheres = {{{-2, 3, -1}, 0.8f, add(scene.materials, emissive(vec3(6, 0, 1)))}};
    const std::array<vec3, 3> triangle{vec3(-1, 4, 2), vec3(1, 4.5f, 1), vec3(0.5f, 5, 3)};
    add_triangle(scene, triangle[0], triangle[1], triangle[2],
                 add(scene.materials, emissive(vec3(20, 1, 1))));
    const vec3 from(0.2f, -0.3f, 0.7f);
    // Van Oosterom and Strackee 1983: tan(W / 2) = a.(b x c) / (1 + a.b + b.c + c.a) for unit a, b, c.
    const auto angle = [&](vec3 p, vec3 q, vec3 r) {
        const dvec3 a = normalize(dvec3(p - from)), b = normalize(dvec3(q - from)),
                    c = normalize(dvec3(r - from));
        return 2 * std::atan2(std::abs(dot(a, cross(b, c))), 1 + dot(a, b) + dot(b, c) + dot(c, a));
    };
    const std::vector<vec3> quad = corners_of(scene.quads[0]);
    const double reach = double(distance(from, scene.spheres[0].center));
    const std::array want{angle(quad[0], quad[1], quad[2]) + angle(quad[0], quad[2], quad[3]),
                          2 * 2 * double(pi) *
                              (1 - std::sqrt(1 - 0.64 / (reach * reach))), // both of its sides
                          angle(triangle[0], triangle[1], triangle[2])};
    const AreaLights lights = collect_area_lights(scene);
    std::array<Mean, 3> mean;
    Random random(73);
    for (int i = 0; i < 60'000; ++i) {
        const LightSample point = sample_light(lights, random.get_2d());
        const vec3 way = point.position - from;
        const float cosine = dot(normalize(way), point.normal);
        const double inverse = 1 / double(light_pdf(lights, point.emission, length(way), cosine));
        const std::size_t which = point.emission.x == 0.5f ? 0 : point.emission.x == 6 ? 1 : 2;
        for (std::size_t k = 0; k < 3; ++k) mean[k].add(k == which ? inverse : 0);
    }
    for (std::size_t k = 0; k < 3; ++k) {
        INFO("light " << k << " (quad, ball, triangle) fills " << mean[k].against(want[k]));
        INFO("off by a constant: the area or the power; off by position: the distance or the cosine");
        CHECK(off(mean[k], want[k]) < 4);
    }
    CHECK_MESSAGE(std::isfinite(light_pdf(lights, vec3(1), 1, 0)),
                  "the pdf must be finite for a lamp seen edge-on");
    CHECK_MESSAGE(light_pdf(AreaLights{}, vec3(1), 1, 0.5f) == 0, "without lamps the pdf must be 0");
}
