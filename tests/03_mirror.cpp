// Facts about the third step: light that is turned around normals, up to a stated number of times.
#include "tests/check.h"

#include "01_spheres/camera.h"
#include "03_mirror/mirror.h"
#include "03_mirror/quad.h"
#include "03_mirror/radiance.h"
#include "03_mirror/scene.h"
#include "common/random.h"

#include <algorithm>
#include <utility>
#include <vector>

using namespace rt;

namespace {

/// What a wrong value usually means: the first of `causes` whose value came.
std::string hint(vec3 got, const std::vector<std::pair<vec3, std::string>>& causes) {
    for (const auto& [value, cause] : causes)
        if (got == approx(value, 1e-4f)) return "got " + to_text(got) + ": " + cause;
    return "got " + to_text(got);
}

/// A direction of length 1, each as likely as any other.
vec3 any_direction(Random& random) {
    const float y = 1 - 2 * random.uniform();
    const float angle = 2 * pi * random.uniform();
    const float r = std::sqrt(std::max(0.0f, 1 - y * y));
    return {r * std::cos(angle), y, r * std::sin(angle)};
}

/// A point of the cube [-size, size]^3.
vec3 any_point(Random& random, float size) {
    const float x = random.uniform(), y = random.uniform(), z = random.uniform();
    return size * (2.0f * vec3(x, y, z) - 1.0f);
}

/// Any vector at a right angle to `direction`, of length 1.
vec3 beside(vec3 direction) {
    const vec3 other = std::abs(direction.x) < 0.6f ? vec3(1, 0, 0) : vec3(0, 1, 0);
    return normalize(cross(direction, other));
}

/// Oblique on purpose: no vector of it lies along an axis or has unit length by chance.
const vec3 tilted = vec3(2, 3, 6) / 7.0f;
const vec3 slanting(1.5f, -2, -1);
const vec3 somewhere(1, -2, 3);

/// A rectangle of this material around `middle` that faces along `normal`, 2 * half wide.
Quad tile(vec3 middle, vec3 normal, float half, int material) {
    const vec3 u = beside(normal), v = cross(normal, u);
    return {middle - half * u - half * v, 2 * half * u, 2 * half * v, material};
}

const vec3 c(0.6f, 2, 0.9f); // the radiance of an even sky

/// A scene that holds one oblique tile of material 0, in an even sky, for a ray that meets it.
Scene one_tile() {
    Scene scene{.sky = {c, c}};
    scene.quads = {tile(somewhere, tilted, 1, 0)};
    return scene;
}
const Ray to_tile{somewhere - 1.5f * slanting, slanting};

} // namespace

// --- mirror.h ---

TEST_CASE("a reflected direction leaves at the angle at which it came") {
    const vec3 r = reflect(slanting, tilted);
    CHECK_MESSAGE(dot(r, tilted) == approx(-dot(slanting, tilted)), "r.n = -d.n");
    const float d_n = dot(slanting, tilted);
    const vec3 expected = slanting - 2 * d_n * tilted;
    CHECK_MESSAGE(
        r == approx(expected),
        hint(r, {{slanting + 2 * d_n * tilted, "d + 2 (d.n) n: the reflection is upside down"},
                 {slanting - 2.0f * (slanting * tilted) * tilted,
                  "the element-wise product in place of the dot: zebra rings on curved mirrors"},
                 {-expected, "the result is negated: it goes into the mirror"},
                 {slanting - d_n * tilted, "d - (d.n) n slides along the surface: take it away twice"},
                 {slanting, "the direction was not turned at all"},
                 {-slanting, "straight back where it came from, whatever the normal"}}));
}

TEST_CASE("a reflected direction keeps its length") {
    Random random(1);
    for (int i = 0; i < 200; ++i) {
        const vec3 d = (0.1f + 5 * random.uniform()) * any_direction(random), n = any_direction(random);
        CHECK_MESSAGE(length(reflect(d, n)) == approx(length(d)), "|r| = |d|, for a d of any length");
    }
}

TEST_CASE("a mirror keeps the part of a direction that lies along it") {
    Random random(2);
    for (int i = 0; i < 200; ++i) {
        const vec3 d = 3.0f * any_direction(random), n = any_direction(random);
        const vec3 along = d - dot(d, n) * n;
        const vec3 r = reflect(d, n);
        CHECK_MESSAGE(r - dot(r, n) * n == approx(along), "the tangential part stays, the normal one turns");
        CHECK_MESSAGE(dot(r, n) == approx(-dot(d, n)), "the tangential part stays, the normal one turns");
    }
}

TEST_CASE("to reflect twice is to do nothing") {
    Random random(3);
    for (int i = 0; i < 200; ++i) {
        const vec3 d = 3.0f * any_direction(random), n = any_direction(random);
        CHECK(reflect(reflect(d, n), n) == approx(d));
    }
}

TEST_CASE("it does not matter to which side the normal points") {
    Random random(4);
    for (int i = 0; i < 200; ++i) {
        const vec3 d = 3.0f * any_direction(random), n = any_direction(random);
        CHECK(reflect(d, -n) == approx(reflect(d, n)));
    }
}

TEST_CASE("a corner of three mirrors sends a ray back where it came from") {
    const vec3 a = tilted, b = beside(tilted), c_ = cross(a, b);
    CHECK(reflect(reflect(reflect(slanting, a), b), c_) == approx(-slanting));
}

TEST_CASE("a ray that is mirrored starts beside the surface, on the side that it came from") {
    const Hit hit = make_hit(Ray{somewhere - slanting, slanting, 0, 1}, tilted, {0, 0}, 0);
    const Ray mirrored = mirror_ray({somewhere - slanting, slanting}, hit);
    CHECK(mirrored.direction == approx(slanting - 2 * dot(slanting, tilted) * tilted));
    CHECK_MESSAGE(dot(mirrored.origin - somewhere, tilted) > 0,
                  "no offset, or one that goes inward: black pepper on the mirror");
    CHECK_MESSAGE(distance(mirrored.origin, somewhere) < 1e-3f, "the offset can be seen");
    CHECK_MESSAGE(mirrored.t_max == infinity, "a mirrored ray goes on for ever");

    const Hit back = make_hit(Ray{somewhere + slanting, -slanting, 0, 1}, tilted, {0, 0}, 0);
    const Ray behind = mirror_ray({somewhere + slanting, -slanting}, back);
    CHECK_MESSAGE(dot(behind.origin - somewhere, tilted) < 0,
                  "a mirror that is seen from its back reflects there");
    CHECK(dot(behind.direction, tilted) < 0);
}

TEST_CASE("a mirror turns rays around the normal to shade with, and starts them off the true surface") {
    const vec3 smooth = normalize(tilted + 0.4f * beside(tilted));
    const Hit hit = make_hit(Ray{somewhere - slanting, slanting, 0, 1}, tilted, smooth, {0, 0}, 0);
    const Ray mirrored = mirror_ray({somewhere - slanting, slanting}, hit);
    CHECK_MESSAGE(mirrored.direction == approx(slanting - 2 * dot(slanting, smooth) * smooth),
                  "turned around hit.geometric_normal, meshes that should look smooth mirror in facets");
    CHECK_MESSAGE(dot(mirrored.origin - somewhere, beside(tilted)) == approx(0, 1e-6f),
                  "the offset goes along hit.geometric_normal: the other may lean into the surface");
}

TEST_CASE("a mirrored ray does not meet the ball that it comes from, of whatever size and wherever") {
    Random random(5);
    for (const float radius : {0.01f, 0.5f, 7.0f, 1000.0f})
        for (const vec3 center : {vec3(0), vec3(1, -2, 3), vec3(-300, 40, 77)}) {
            const Sphere ball{center, radius, 0};
            int again = 0, hits = 0;
            for (int i = 0; i < 3000; ++i) {
                const vec3 eye = center + 4 * radius * any_direction(random);
                Ray ray{eye, 0.5f * (center + 0.98f * radius * any_direction(random) - eye)};
                const auto t = intersect(ball, ray);
                if (!t) continue;
                ++hits;
                ray.t_max = *t;
                again += intersect(ball, mirror_ray(ray, surface(ball, ray))).has_value();
            }
            INFO("radius " << radius << " around " << to_text(center));
            CHECK_MESSAGE(again == 0,
                          again << " of " << hits << " mirrored rays: black pepper on the mirror");
            CHECK(hits > 2900);
        }
}

// --- radiance.h: mirrors ---

TEST_CASE("a mirror of tint s in a sky of radiance c shows s c") {
    const vec3 s(0.5f, 0.9f, 0.2f);
    Scene scene = one_tile();
    add(scene, Mirror{s});
    const vec3 seen = radiance(scene, to_tile, 5);
    CHECK_MESSAGE(seen == approx(s * c),
                  hint(seen, {{c, "the tint was forgotten"},
                              {s * s * c, "the tint was applied twice"},
                              {s, "the tint in place of what is seen in it"},
                              {vec3(0), "black: the recursion never starts, the mirrored ray "
                                        "goes inward, or it meets its own mirror"}}));
    CHECK_MESSAGE(radiance(scene, Ray{somewhere + slanting, -slanting}, 5) == approx(s * c),
                  "from behind as well");
}

TEST_CASE("a mirror shows the sky that lies in the reflected direction") {
    Scene scene = one_tile();
    scene.sky = {{0.1f, 0.2f, 0.9f}, {0.7f, 0.4f, 0.1f}};
    add(scene, Mirror{{0.5f, 0.9f, 0.2f}});
    const float d_n = dot(slanting, tilted);
    const vec3 r = slanting - 2 * d_n * tilted;
    const vec3 tint(0.5f, 0.9f, 0.2f), seen = radiance(scene, to_tile, 5);
    CHECK_MESSAGE(seen == approx(tint * radiance(scene.sky, r)),
                  hint(seen, {{tint * radiance(scene.sky, slanting), "the ray went straight on"},
                              {tint * radiance(scene.sky, -r), "the reflected direction is negated"},
                              {tint * radiance(scene.sky, slanting + 2 * d_n * tilted), "upside down"}}));
}

TEST_CASE("a mirror ball shows in each point what lies in the reflected direction") {
    // A target far away in that direction, and nothing else that glows.
    Random random(6);
    int found = 0;
    for (int i = 0; i < 200; ++i) {
        const Sphere ball{somewhere, 2, 0};
        const vec3 n = any_direction(random);
        const vec3 point = ball.center + ball.radius * n;
        const vec3 from = normalize(n + 0.9f * any_direction(random)); // leads away from the ball
        const vec3 to = 2 * dot(from, n) * n - from;                   // as much to the other side of n
        Scene scene;
        add(scene, Mirror{{0.5f, 0.9f, 0.2f}});
        scene.spheres = {ball, {point + 9.0f * to, 0.1f, add(scene, flat({3, 2, 1}))}};
        found += radiance(scene, Ray{point + 3.0f * from, -2.0f * from}, 1) == approx(vec3(1.5f, 1.8f, 0.2f));
    }
    CHECK_MESSAGE(found == 200, found << " of 200 mirrored targets were seen");
}

namespace {

/// Two facing mirrors of tint s, turned away from all axes, and the ray that meets them `bounces` times
/// before it leaves between them into the sky.
struct Hall {
    Scene scene{.sky = {c, c}};
    Ray ray;

    Hall(int bounces, vec3 s) {
        const vec3 up = beside(tilted), along = cross(tilted, up);
        const float height = 0.1f * float(2 * bounces); // the ray rises .2 from one mirror to the other
        for (const float side : {-1.0f, 1.0f})
            scene.quads.push_back({somewhere + side * tilted - 3.0f * along - up, 6.0f * along,
                                   (height + 1) * up, add(scene, Mirror{s})});
        ray = {somewhere, 1.7f * (tilted + 0.1f * up + 0.05f * along)};
    }
};

} // namespace

TEST_CASE("eight facing mirrors of tint .9 show .43047 of the sky") {
    const Hall hall(8, {0.9f, 0.5f, 1});
    const vec3 seen = radiance(hall.scene, hall.ray, 20);
    const vec3 expected = vec3(0.43046721f, 0.00390625f, 1) * c;
    CHECK_MESSAGE(
        seen == approx(expected, 1e-6f),
        hint(seen, {{c, "the tint was forgotten"},
                    {vec3(0.9f, 0.5f, 1) * c, "the tint was applied only once"},
                    {vec3(0), "black: too few bounces, or a mirrored ray was lost"},
                    {vec3(0.4782969f, 0.0078125f, 1) * c, "seven bounces: one was left out"},
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

TEST_CASE("a ray may meet exactly as many mirrors as its depth says, and is black after them") {
    for (const int k : {1, 2, 3, 8, 12}) {
        const Hall hall(k, {0.9f, 0.5f, 1});
        const vec3 whole = vec3(std::pow(0.9f, float(k)), std::pow(0.5f, float(k)), 1) * c;
        INFO(k << " mirrors on the way");
        CHECK_MESSAGE(radiance(hall.scene, hall.ray, k) == approx(whole),
                      "depth " << k << " is enough: one mirror too few was allowed");
        CHECK_MESSAGE(radiance(hall.scene, hall.ray, k + 1) == approx(whole),
                      "a greater depth changes nothing");
        CHECK_MESSAGE(radiance(hall.scene, hall.ray, k - 1) == vec3(0),
                      "depth " << k - 1
                               << " must not be enough: the light beyond the last mirror is left out");
    }
}

TEST_CASE("at depth 0 mirrors are black and all else is as it is") {
    Scene scene = one_tile();
    add(scene, Mirror{vec3(1)});
    scene.quads.push_back(tile(somewhere + 9.0f * tilted, tilted, 1, add(scene, flat({3, 2, 1}))));
    CHECK(radiance(scene, to_tile, 0) == vec3(0));
    CHECK(radiance(scene, Ray{somewhere + 5.0f * tilted, 2.0f * tilted}, 0) == approx(vec3(3, 2, 1)));
    CHECK_MESSAGE(radiance(scene, Ray{somewhere + 5.0f * tilted, 2.0f * beside(tilted)}, 0) == approx(c),
                  "the sky is no mirror");
}

TEST_CASE("inside a closed mirror with no light it is exactly dark") {
    // However bright the sky is outside: no ray may slip out.
    Random random(7);
    Scene shell{.sky = {vec3(1000), vec3(1000)}};
    shell.spheres = {{somewhere, 2, add(shell, Mirror{vec3(1)})}};
    Scene box{.sky = {vec3(1000), vec3(1000)}};
    const int silver = add(box, Mirror{vec3(1)});
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
    CHECK_MESSAGE(shell_leaks == 0, shell_leaks
                                        << " of 500 rays got out of the ball: the offset went outward, or "
                                           "light was added after the last mirror");
    CHECK_MESSAGE(box_leaks == 0, box_leaks << " of 500 rays got out of the box");
}

TEST_CASE("inside a ball with a mirror for a wall, a lamp is seen by way of the wall") {
    Scene scene;
    const vec3 lamp = somewhere + vec3(0, 0.5f, 0);
    add(scene, Mirror{{0.9f, 0.5f, 1}});
    scene.spheres = {{somewhere, 2, 0}, {lamp, 0.1f, add(scene, flat({3, 2, 1}))}};
    // up to the wall through nothing, straight back, and on to the lamp from the other side
    CHECK(radiance(scene, Ray{somewhere + vec3(0, 1, 0), {0, 2, 0}}, 5) == approx(vec3(2.7f, 1, 1)));
    CHECK(radiance(scene, Ray{somewhere, {0, -2, 0}}, 5) == approx(vec3(2.7f, 1, 1)));
}

namespace {

/// Tiles that send a ray along these points, from the first by way of the others, each with its own tint, to
/// a ball that glows around the last. Every normal halves the angle between the way in and the way out.
Scene path_of(const std::vector<vec3>& points, const std::vector<vec3>& tints, vec3 glow) {
    Scene scene;
    for (std::size_t i = 1; i + 1 < points.size(); ++i) {
        const vec3 normal =
            normalize(normalize(points[i - 1] - points[i]) + normalize(points[i + 1] - points[i]));
        scene.quads.push_back(tile(points[i], normal, 0.2f, add(scene, Mirror{tints[i - 1]})));
    }
    scene.spheres = {{points.back(), 0.15f, add(scene, flat(glow))}};
    return scene;
}

} // namespace

TEST_CASE("a path of three hops shows the ball that stands on its third segment") {
    const std::vector<vec3> points{{0, 0, 0}, {1, 0.5f, -4}, {-2.5f, 1.5f, -1.5f}, {-1, -2, -3.5f}};
    const Scene scene = path_of(points, {{0.9f, 0.5f, 0.8f}, {0.5f, 1, 0.7f}}, {2, 3, 4});
    const Ray eye{points[0], 0.8f * (points[1] - points[0])};
    const vec3 seen = radiance(scene, eye, 12);
    CHECK_MESSAGE(seen == approx(vec3(0.9f, 1.5f, 2.24f)),
                  hint(seen, {{vec3(0), "black: the recursion is too shallow, or a reflection went astray"},
                              {{2, 3, 4}, "the tints were forgotten"},
                              {{1, 3, 2.8f}, "the first mirror's tint was forgotten"},
                              {{1.8f, 1.5f, 3.2f}, "the second mirror's tint was forgotten"}}));
    CHECK_MESSAGE(radiance(scene, eye, 2) == approx(vec3(0.9f, 1.5f, 2.24f)), "two mirrors lie on the way");
    CHECK_MESSAGE(radiance(scene, eye, 1) == vec3(0), "one mirror is not enough");
}

TEST_CASE("a path goes on over five oblique mirrors") {
    const std::vector<vec3> points{{0, 0, 0},        {1, 0.5f, -4},    {-2.5f, 1.5f, -1.5f}, {-1, -2, -3.5f},
                                   {2.5f, -1.5f, 1}, {-1.5f, 3, 2.5f}, {3, 2.5f, 1}};
    const Scene scene = path_of(points, std::vector(5, vec3(0.5f, 0.9f, 1)), {64, 3, 4});
    const Ray eye{points[0], points[1] - points[0]};
    CHECK(radiance(scene, eye, 5) == approx(vec3(2, 3 * 0.59049f, 4)));
    CHECK(radiance(scene, eye, 4) == vec3(0));
}

TEST_CASE("a matte ball in a mirror is as bright as the ball itself") {
    Scene scene;
    const vec3 ball(-1, -2, -3.5f), on_mirror(1, 0.5f, -4), eye(0, 0, 0);
    const int silver = add(scene, Mirror{vec3(1)});
    const vec3 normal = normalize(normalize(eye - on_mirror) + normalize(ball - on_mirror));
    scene.quads = {tile(on_mirror, normal, 0.3f, silver)};
    scene.spheres = {{ball, 0.5f, add(scene, Diffuse{{0.8f, 0.4f, 0.6f}})}};
    scene.lights = {{{2, 3, -1}, {9, 8, 7}}};
    const vec3 directly = radiance(scene, Ray{on_mirror - 0.01f * (on_mirror - ball), ball - on_mirror}, 3);
    REQUIRE(directly.x > 0.01f);
    CHECK(radiance(scene, Ray{eye, 2.0f * (on_mirror - eye)}, 3) == approx(directly));
}

TEST_CASE("a mirror hides the light behind it") {
    Scene scene;
    scene.planes = {{{0, 0, 0}, {0, 1, 0}, add(scene, Diffuse{vec3(0.5f)})}};
    scene.lights = {{{1, 2, -1}, vec3(pi)}};
    const Ray down{{1, 0.3f, -1}, {0, -2, 0}};
    CHECK(radiance(scene, down, 3) == approx(vec3(0.125f)));
    scene.quads = {tile({1, 1, -1}, tilted, 0.4f, add(scene, Mirror{vec3(1)}))};
    CHECK_MESSAGE(radiance(scene, down, 3) == vec3(0), "quads cast shadows");
    scene.quads = {tile({1, 3, -1}, tilted, 0.4f, 1)};
    CHECK_MESSAGE(radiance(scene, down, 3) == approx(vec3(0.125f)), "it stands beyond the light");
}

// --- radiance.h: reflective ---

TEST_CASE("a reflective surface blends its base with what it mirrors") {
    const vec3 tint(0.5f, 0.9f, 0.2f), glow(3, 0.3f, 1);
    for (const float reflectivity : {0.0f, 0.25f, 0.8f, 1.0f}) {
        Scene scene = one_tile();
        scene.quads[0].material = 1;
        add(scene, flat(glow));
        add(scene, Reflective{reflectivity, 0, tint});
        const vec3 seen = radiance(scene, to_tile, 5);
        INFO("reflectivity " << reflectivity);
        CHECK_MESSAGE(
            seen == approx((1 - reflectivity) * glow + reflectivity * tint * c),
            hint(seen, {{glow + reflectivity * tint * c, "the mirror is added on top of the whole base"},
                        {reflectivity * glow + (1 - reflectivity) * tint * c, "base and mirror swapped"},
                        {(1 - reflectivity) * glow + reflectivity * c, "the tint was forgotten"},
                        {reflectivity * tint * c, "the base was left out"},
                        {glow, "only the base"},
                        {tint * c, "only the mirror"}}));
    }
}

TEST_CASE("at reflectivity 0 a surface is its base, at 1 a mirror, to the last bit") {
    Scene scene = one_tile();
    scene.sky = {{0.1f, 0.2f, 0.9f}, {0.7f, 0.4f, 0.1f}};
    scene.lights = {{somewhere + 2.0f * tilted + beside(tilted), vec3(5, 4, 3)}};
    const vec3 tint(0.5f, 0.9f, 0.2f);
    const int matte = add(scene, Diffuse{{0.8f, 0.4f, 0.6f}});
    const int mirror = add(scene, Mirror{tint});
    const auto seen = [&](int material) {
        scene.quads[0].material = material;
        return radiance(scene, to_tile, 5);
    };
    CHECK(seen(add(scene, Reflective{0, matte, tint})) == seen(matte));
    CHECK(seen(add(scene, Reflective{1, matte, tint})) == seen(mirror));
}

TEST_CASE("the base of a reflective surface is lit and in shadow like any other") {
    Scene scene; // a black sky: what is seen is the base's share alone
    scene.quads = {tile(somewhere, tilted, 1, 1)};
    scene.lights = {{somewhere + 2.0f * tilted, vec3(pi)}};
    add(scene, Diffuse{{0.8f, 0.4f, 0.5f}});
    add(scene, Reflective{0.25f, 0, vec3(1)});
    CHECK(radiance(scene, to_tile, 5) == approx(0.75f * vec3(0.2f, 0.1f, 0.125f)));
    scene.spheres = {{somewhere + 1.5f * tilted, 0.1f, 0}};
    CHECK(radiance(scene, to_tile, 5) == vec3(0));
}

TEST_CASE("a reflective checker shows its squares through the mirror") {
    const vec3 even(0.8f, 0.2f, 0.1f), odd(0.1f, 0.4f, 0.3f), tint(0.5f, 0.9f, 0.2f);
    Scene scene{.sky = {c, c}};
    add(scene, Checker{even, odd, 0.5f});
    scene.planes = {{{0, 0, 0}, {0, 1, 0}, add(scene, Reflective{0.25f, 0, tint})}};
    const auto seen = [&](float x, float z) {
        const vec3 view(0.6f, -1, 0.4f);
        return radiance(scene, Ray{vec3(x, 0, z) - 2.0f * view, view}, 5);
    };
    CHECK(seen(0.2f, -0.3f) == approx(0.75f * even * c + 0.25f * tint * c));
    CHECK(seen(0.7f, -0.3f) == approx(0.75f * odd * c + 0.25f * tint * c));
    CHECK(seen(-0.2f, -0.3f) == approx(0.75f * odd * c + 0.25f * tint * c));
}

TEST_CASE("a reflective coat may lie over a mirror") {
    const vec3 coat(0.5f, 0.9f, 0.2f), silver(1, 0.3f, 0.6f);
    for (const float reflectivity : {0.0f, 0.25f, 1.0f}) {
        Scene scene = one_tile();
        scene.quads[0].material = 1;
        add(scene, Mirror{silver});
        add(scene, Reflective{reflectivity, 0, coat});
        INFO("reflectivity " << reflectivity);
        CHECK(radiance(scene, to_tile, 5) ==
              approx((1 - reflectivity) * silver * c + reflectivity * coat * c));
        CHECK_MESSAGE(radiance(scene, to_tile, 1) ==
                          approx((1 - reflectivity) * silver * c + reflectivity * coat * c),
                      "coat and mirror are one surface: a depth of 1 is enough for both");
        CHECK(radiance(scene, to_tile, 0) == vec3(0));
    }
}

TEST_CASE("a reflective coat may lie over another one") {
    const vec3 outer(0.5f, 0.9f, 0.2f), inner(1, 0.3f, 0.6f), glow(3, 0.3f, 1);
    Scene scene = one_tile();
    scene.quads[0].material = 2;
    add(scene, flat(glow));
    add(scene, Reflective{0.4f, 0, inner});
    add(scene, Reflective{0.25f, 1, outer});
    const vec3 base = 0.6f * glow + 0.4f * inner * c;
    CHECK(radiance(scene, to_tile, 5) == approx(0.75f * base + 0.25f * outer * c));
    CHECK_MESSAGE(radiance(scene, to_tile, 0) == approx(0.75f * 0.6f * glow), "the base needs no depth");
}

TEST_CASE("a reflective surface counts as a mirror, and its base costs no depth") {
    const vec3 glow(3, 0.3f, 1);
    Scene scene = one_tile();
    scene.quads[0].material = 1;
    add(scene, flat(glow));
    add(scene, Reflective{0.25f, 0, vec3(1)});
    CHECK_MESSAGE(radiance(scene, to_tile, 1) == approx(0.75f * glow + 0.25f * c), "one mirror on the way");
    CHECK_MESSAGE(radiance(scene, to_tile, 0) == approx(0.75f * glow),
                  "no mirror is allowed: the base stays, its share does not grow");
}

TEST_CASE("two lacquered walls show each other as often as the depth says") {
    // At each wall .75 of the glow, and .25 of what the other one shows: a geometric series.
    for (int depth = 0; depth <= 6; ++depth) {
        Hall hall(20, vec3(0));
        hall.scene.materials = {Reflective{0.25f, 2, vec3(1)}, Reflective{0.25f, 2, vec3(1)},
                                flat({4, 8, 2})};
        INFO("depth " << depth);
        CHECK(radiance(hall.scene, hall.ray, depth) ==
              approx(vec3(4, 8, 2) * (1 - std::pow(0.25f, float(depth + 1)))));
    }
}

TEST_CASE("white things vanish in an even sky, whatever share of them is a mirror") {
    for (const float reflectivity : {0.0f, 0.25f, 0.5f, 1.0f}) {
        Scene scene{.sky = {c, c}};
        add(scene, Diffuse{vec3(1)});
        add(scene, Reflective{reflectivity, 0, vec3(1)});
        scene.spheres = {{somewhere, 2, 1}};
        CHECK(radiance(scene, Ray{somewhere + vec3(4, 3, 5), {-0.7f, -0.5f, -1}}, 4) == approx(c));
    }
}

// --- quad.h ---

namespace {
/// Skewed, oblique, and with sides of different length.
const Quad quad{{1, -2, 3}, {2, 0.5f, -1}, {-0.3f, 1.2f, 0.7f}, 5};
const vec3 quad_normal = normalize(cross(quad.edge_u, quad.edge_v));

vec3 on_quad(float u, float v) {
    return quad.corner + u * quad.edge_u + v * quad.edge_v;
}

/// A slanting ray to this point of the quad, which it meets at t = 1.5, from the side that it faces.
Ray to_quad(float u, float v) {
    const vec3 direction = -2.0f * quad_normal + 0.7f * beside(quad_normal);
    return {on_quad(u, v) - 1.5f * direction, direction};
}

float t_of(const std::optional<float>& t) {
    return t.value_or(std::numeric_limits<float>::quiet_NaN());
}
} // namespace

TEST_CASE("a quad is met between its edges and missed beyond them") {
    for (const float inside : {0.001f, 0.3f, 0.999f})
        for (const float other : {0.001f, 0.6f, 0.999f}) {
            INFO("u = " << inside << ", v = " << other);
            CHECK(t_of(intersect(quad, to_quad(inside, other))) == approx(1.5f));
        }
    for (const float outside : {-0.5f, -0.001f, 1.001f, 1.5f})
        for (const float other : {-0.2f, 0.001f, 0.5f, 0.999f}) {
            INFO("outside = " << outside << ", other = " << other);
            CHECK_FALSE_MESSAGE(intersect(quad, to_quad(outside, other)), "beyond the edge across u");
            CHECK_FALSE_MESSAGE(intersect(quad, to_quad(other, outside)), "beyond the edge across v");
        }
}

TEST_CASE("a quad is met on both sides of its diagonal") {
    CHECK(intersect(quad, to_quad(0.2f, 0.2f)));
    CHECK_MESSAGE(intersect(quad, to_quad(0.9f, 0.9f)),
                  "u + v > 1 is the other half: that would be a triangle");
}

TEST_CASE("t on a quad counts in lengths of the direction, within the ray's interval") {
    Ray ray = to_quad(0.4f, 0.7f);
    CHECK(t_of(intersect(quad, ray)) == approx(1.5f));
    CHECK(t_of(intersect(quad, Ray{ray.origin, 2.0f * ray.direction})) == approx(0.75f));
    CHECK_FALSE_MESSAGE(intersect(quad, Ray{ray.origin, -ray.direction}), "it lies behind");
    CHECK_FALSE_MESSAGE(intersect(quad, Ray{ray.origin, ray.direction, 0, 1.4f}), "it lies beyond t_max");
    CHECK_FALSE_MESSAGE(intersect(quad, Ray{ray.origin, ray.direction, 1.6f}), "it lies before t_min");
}

TEST_CASE("a ray along a quad misses it") {
    const Quad flat_quad{{0, 1, 0}, {2, 0, 0}, {0, 0, -3}, 0};
    CHECK_FALSE(intersect(flat_quad, Ray{{-1, 1, -1}, {1, 0, 0}}));
    CHECK_FALSE(intersect(flat_quad, Ray{{-1, 2, -1}, {1, 0, 0.2f}}));
}

TEST_CASE("u and v of a quad run along its edges from the corner") {
    for (const vec2 uv : {vec2(0.25f, 0.75f), vec2(0.9f, 0.1f), vec2(0, 1), vec2(1, 0), vec2(-0.5f, 2)})
        CHECK_MESSAGE(quad_uv(quad, on_quad(uv.x, uv.y)) == approx(uv),
                      "u along edge_u and v along edge_v, also if they are not at right angles");
    const Ray ray = to_quad(0.25f, 0.75f);
    const Hit hit = surface(quad, Ray{ray.origin, ray.direction, 0, 1.5f});
    CHECK(hit.uv == approx(vec2(0.25f, 0.75f)));
    CHECK(hit.position == approx(on_quad(0.25f, 0.75f)));
    CHECK(hit.material == 5);
}

TEST_CASE("a quad faces the cross product of its edges, and its back is turned to who looks at it") {
    const Ray ray = to_quad(0.4f, 0.7f);
    const Hit front = surface(quad, Ray{ray.origin, ray.direction, 0, 1.5f});
    CHECK(front.normal == approx(quad_normal));
    CHECK_FALSE(front.inside);
    CHECK(front.geometric_normal == approx(quad_normal));
    const Ray from_behind{at(ray, 3), -ray.direction};
    CHECK(t_of(intersect(quad, from_behind)) == approx(1.5f));
    const Hit back = surface(quad, Ray{from_behind.origin, from_behind.direction, 0, 1.5f});
    CHECK(back.normal == approx(-quad_normal));
    CHECK(back.inside);
    CHECK(back.uv == approx(vec2(0.4f, 0.7f)));
}

// --- scene.h ---

TEST_CASE("of balls, planes and quads a ray meets the nearest, in whatever order they stand") {
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
            CHECK_MESSAGE(hit->material == t, "materials count the shapes along the ray");
            CHECK(hit->t == approx(float(t)));
        }
        CHECK_FALSE(intersect(scene, Ray{origin, direction, 0, 0.9f}));
    } while (std::next_permutation(order.begin(), order.end()));
}

TEST_CASE("a segment is occluded exactly if it meets something") {
    Random random(8);
    Scene scene;
    for (int i = 0; i < 20; ++i) {
        scene.spheres.push_back({any_point(random, 3), 0.1f + 0.5f * random.uniform(), 0});
        scene.quads.push_back({any_point(random, 3), any_point(random, 1), any_point(random, 1), 0});
    }
    scene.planes = {{{0, -2, 0}, normalize(vec3(1, 9, 2)), 0}};
    int wrong = 0, hidden = 0;
    for (int i = 0; i < 10000; ++i) {
        const vec3 from = any_point(random, 3);
        const Ray ray{from, any_point(random, 3) - from, 0.2f * random.uniform(), 0.2f + random.uniform()};
        const bool meets = intersect(scene, ray).has_value();
        hidden += meets;
        wrong += occluded(scene, ray) != meets;
    }
    CHECK_MESSAGE(wrong == 0, wrong << " of 10000 segments");
    CHECK(hidden > 2000); // that there is something to check
    CHECK(hidden < 8000);
}
