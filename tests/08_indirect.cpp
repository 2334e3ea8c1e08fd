// Facts about light that has been around: bounces, area lights, and walks whose answer is known in closed
// form. Noisy facts are z-tests with a fixed seed: a right renderer is beyond |z| = 4 in one run of 16,000.
#include "08_indirect/area_light.h"
#include "08_indirect/bounce.h"
#include "08_indirect/metal.h"
#include "08_indirect/radiance.h"
#include "08_indirect/scene.h"
#include "common/obj_file.h"
#include "tests/check.h"

#include <unistd.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <string>
#include <vector>

using namespace rt;
using glm::dvec3;

namespace {

const std::array<vec3, 9> normals{vec3(0, 1, 0),
                                  vec3(0, 0, 1),
                                  vec3(0, 0, -1),
                                  vec3(-1, 0, 0),
                                  normalize(vec3(0.3f, -0.5f, -0.9f)),
                                  normalize(vec3(1, 2, -2)),
                                  normalize(vec3(-0.4f, 0.2f, 0.7f)),
                                  normalize(vec3(1e-4f, -2e-4f, -1)),
                                  normalize(vec3(3, -1, -1e-6f))};

/// How many standard errors the mean is off; a difference within rounding is none.
double off(const Mean& mean, double want) {
    return std::abs(mean.mean() - want) <= 1e-5 * std::max(1.0, std::abs(want)) ? 0 : std::abs(mean.z(want));
}

/// A place that receives light.
Hit facing(vec3 position, vec3 normal) {
    return {0, position, normal, normal, vec2(0), 0, false, position_error(position, position)};
}

/// What the area lights of a scene send to a place: red, in units of pi.
Mean received(Scene& scene, vec3 position, vec3 normal, int samples = 20'000, std::uint64_t seed = 3) {
    prepare(scene);
    const AreaLights lights = area_lights(scene);
    Random random(seed);
    Mean mean;
    for (int i = 0; i < samples; ++i)
        mean.add(double(area_light(scene, lights, facing(position, normal), random).x / pi));
    return mean;
}

/// The red light that comes back along a ray.
Mean seen(Scene& scene, const Transport& transport, const Ray& ray, int samples = 20'000,
          std::uint64_t seed = 3) {
    prepare(scene);
    const AreaLights lights = area_lights(scene);
    Random random(seed);
    Mean mean;
    for (int i = 0; i < samples; ++i) mean.add(double(radiance(scene, lights, transport, ray, random).x));
    return mean;
}

/// Lambert's formula, in units of pi: the share of an evenly bright half-sphere that a polygon fills, cosine
/// included. 1 / (2 pi) sum theta_i gamma_i . n over its edges; all of it must lie above the surface.
double form_factor(const std::vector<vec3>& polygon, vec3 position, vec3 normal) {
    double sum = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const dvec3 a = normalize(dvec3(polygon[i]) - dvec3(position));
        const dvec3 b = normalize(dvec3(polygon[(i + 1) % polygon.size()]) - dvec3(position));
        sum += std::acos(dot(a, b)) * dot(normalize(cross(a, b)), dvec3(normal));
    }
    return std::abs(sum) / (2 * double(pi));
}
std::vector<vec3> corners_of(const Quad& quad) {
    return {quad.corner, quad.corner + quad.edge_u, quad.corner + quad.edge_u + quad.edge_v,
            quad.corner + quad.edge_v};
}

void add_triangle(Scene& scene, vec3 a, vec3 b, vec3 c, int material) {
    const auto first = std::uint32_t(scene.mesh.positions.size());
    for (const vec3 corner : {a, b, c}) {
        scene.mesh.positions.push_back(corner);
        scene.mesh.normals.push_back(normalize(cross(b - a, c - a)));
        scene.mesh.uvs.push_back(vec2(0));
    }
    scene.mesh.triangles.push_back({first, first + 1, first + 2});
    scene.mesh.materials.push_back(material);
}

/// A closed room in the shape of a ball of radius 2, evenly bright and evenly grey. From inside, light
/// sampling has no noise: cos cos' / r^2 is the same for all pairs of points.
Scene ball_room(vec3 albedo, vec3 emission) {
    Scene scene;
    scene.spheres = {{{1, -0.5f, 3}, 2, add(scene, Diffuse{albedo, emission})}};
    prepare(scene);
    return scene;
}
const std::array all_ways{Direct::mis, Direct::lights, Direct::bounces};
const Ray in_ball_room{{0.5f, 0.3f, 2.5f}, normalize(vec3(0.7f, 0.2f, -0.4f))};

std::string words(const Transport& transport) {
    return "depth " + std::to_string(transport.depth) + (transport.indirect ? "" : ", no indirect light") +
           (transport.direct == Direct::mis      ? ", lights sampled and found"
            : transport.direct == Direct::lights ? ", lights sampled"
                                                 : ", lights found by chance") +
           (transport.spread == Spread::cosine ? "" : ", uniform bounces") +
           (transport.roulette ? ", roulette" : ", no roulette");
}

/// Pearson's chi-square of found counts against expected ones.
double chi_square(const std::vector<double>& found, const std::vector<double>& expected) {
    double sum = 0;
    for (std::size_t i = 0; i < found.size(); ++i)
        sum += (found[i] - expected[i]) * (found[i] - expected[i]) / expected[i];
    return sum;
}

/// An angle around `normal`, in [0, 1), from a direction at right angles to it that this check picks itself.
double azimuth(vec3 normal, vec3 direction) {
    const dvec3 n(normal);
    const dvec3 right = normalize(cross(n, std::abs(n.x) < 0.6 ? dvec3(1, 0, 0) : dvec3(0, 1, 0)));
    const double angle = std::atan2(dot(cross(n, right), dvec3(direction)), dot(right, dvec3(direction)));
    return std::min(angle / (2 * double(pi)) + 0.5, 0.9999999);
}

} // namespace

// ---- bounces

TEST_CASE("two tangents and the normal stand at right angles, for every normal") {
    Random random(1);
    std::vector<vec3> all(normals.begin(), normals.end());
    for (int i = 0; i < 1000; ++i)
        all.push_back(normalize(vec3(random.uniform(), random.uniform(), random.uniform()) - 0.5f));
    for (const vec3 n : all) {
        const Tangents pair = tangents(n);
        const vec3 u = pair.u, v = pair.v;
        INFO("normal " << to_text(n) << " has tangents " << to_text(u) << " and " << to_text(v));
        INFO("NaN at (0, 0, -1): a cross product with the normal itself, or a division by 1 + z");
        REQUIRE(length(u) == approx(1));
        REQUIRE(length(v) == approx(1));
        REQUIRE(dot(u, n) == approx(0));
        REQUIRE(dot(v, n) == approx(0));
        REQUIRE(dot(u, v) == approx(0));
    }
}

TEST_CASE("a bounce has unit length and leaves above the surface") {
    const float most = 1 - 0x1p-24f;
    Random random(2);
    for (const vec3 normal : normals) {
        std::vector<vec2> all{{0, 0}, {0, most}, {most, 0}, {most, most}, {0.5f, 0.25f}};
        for (int i = 0; i < 2000; ++i) all.push_back(random.uniform2());
        for (const vec2 u : all) {
            const vec3 direction = cosine_direction(normal, u);
            INFO("normal " << to_text(normal) << ", u " << to_text(u) << ", direction "
                           << to_text(direction));
            REQUIRE(length(direction) == approx(1));
            REQUIRE_MESSAGE(dot(direction, normal) > 0, "below the surface: light comes out of the table");
        }
    }
}

TEST_CASE("bounces crowd around the normal by Lambert's cosine") {
    for (const vec3 normal : normals) {
        Mean cosine, inverse;
        std::vector<double> found(10), even(10, 2000);
        Random random(3);
        for (int i = 0; i < 20'000; ++i) {
            const float c = dot(cosine_direction(normal, random.uniform2()), normal);
            cosine.add(double(c));
            inverse.add(c > 0.02f ? 1 / double(cosine_pdf(c)) : 0);
            found[std::size_t(std::clamp(int(c * c * 10), 0, 9))] += 1;
        }
        INFO("normal " << to_text(normal));
        INFO("mean cosine, 2/3; 1/2 would be uniform directions, 3/4 cos^2: " << cosine.against(2.0 / 3));
        CHECK(off(cosine, 2.0 / 3) < 4);
        // All directions within acos(.02) of the normal fill 2 pi (1 - .02); without that cut 1/pdf has no
        // variance.
        const double directions = 2 * double(pi) * 0.98;
        INFO("mean of 1/pdf, the solid angle of all directions, 2 pi: " << inverse.against(directions));
        CHECK(off(inverse, directions) < 4);
        INFO("cos^2 is uniform; chi-square of ten bins is above 27.9 once in 1,000 for each of nine normals");
        CHECK(chi_square(found, even) < 27.9);
    }
}

TEST_CASE("the mean of 1/pdf over all bounces is 2 pi") {
    // Evenly spaced u in place of chance: the sum converges with the root of the step.
    double sum = 0;
    const int steps = 400'000;
    const vec3 normal = normals[4];
    for (int i = 0; i < steps; ++i) {
        const vec3 direction = cosine_direction(normal, {(float(i) + 0.5f) / float(steps), 0.37f});
        sum += 1 / double(cosine_pdf(dot(direction, normal))) / steps;
    }
    INFO("pi would be a pdf without its pi, 2 pi the right one");
    CHECK(float(sum) == approx(2 * pi, 2e-3f));
}

TEST_CASE("the declared density of bounces is that of the bounces") {
    // 8 x 12 cells of equal solid angle around an oblique normal; what each should get is the pdf, summed up.
    // 95 degrees of freedom: above 163.3 once in 50,000. It sees the azimuth too.
    const int cosines = 8, angles = 12, samples = 60'000;
    for (const vec3 normal : {normals[4], normals[5], normals[2]}) {
        std::vector<double> found(cosines * angles), expected(cosines * angles);
        Random random(5);
        for (int i = 0; i < samples; ++i) {
            const vec3 direction = cosine_direction(normal, random.uniform2());
            const int row = std::clamp(int(dot(direction, normal) * cosines), 0, cosines - 1);
            found[std::size_t(row * angles + int(azimuth(normal, direction) * angles))] += 1;
        }
        for (int row = 0; row < cosines; ++row)
            for (int angle = 0; angle < angles; ++angle)
                for (int i = 0; i < 100; ++i) {
                    const float c = (float(row) + (float(i) + 0.5f) / 100) / cosines;
                    expected[std::size_t(row * angles + angle)] +=
                        samples * double(cosine_pdf(c)) * 2 * double(pi) / angles / cosines / 100;
                }
        double total = 0;
        for (const double cell : expected) total += cell / samples;
        CHECK_MESSAGE(float(total) == approx(1, 1e-4f),
                      "the density is to integrate to 1 over the half-sphere");
        INFO("normal " << to_text(normal)
                       << ": a sampler with the density of another one, or an uneven azimuth");
        CHECK(chi_square(found, expected) < 163.3);
    }
    CHECK_MESSAGE(cosine_pdf(-0.4f) == 0, "no bounce goes below the surface");
    CHECK(cosine_pdf(0.4f) == approx(0.4f / pi));
}

TEST_CASE("bounces go as often to the left as to the right") {
    // 24 bins, 23 degrees of freedom: above 62 once in 50,000.
    for (const vec3 normal : normals) {
        std::vector<double> found(24), even(24, 1000);
        Mean with_height;
        Random random(7);
        for (int i = 0; i < 24'000; ++i) {
            const vec3 direction = cosine_direction(normal, random.uniform2());
            const double turn = azimuth(normal, direction);
            found[std::size_t(turn * 24)] += 1;
            with_height.add(std::cos(2 * double(pi) * turn) * double(dot(direction, normal)));
        }
        INFO("normal " << to_text(normal));
        CHECK(chi_square(found, even) < 62);
        INFO("the angle around the normal knows nothing of the height: " << with_height.against(0));
        CHECK(off(with_height, 0) < 4);
    }
}

TEST_CASE("roulette leaves the mean of what a path carries unchanged") {
    for (const vec3 carried :
         {vec3(0.2f, 0.05f, 0.1f), vec3(0.02f), vec3(0.5f, 0.9f, 0.1f), vec3(1), vec3(1.3f)}) {
        std::array<Mean, 3> mean;
        Random random(11);
        for (int i = 0; i < 50'000; ++i) {
            const vec3 left = roulette(carried, random).value_or(vec3(0));
            for (int k = 0; k < 3; ++k) mean[std::size_t(k)].add(double(left[k]));
        }
        for (int k = 0; k < 3; ++k) {
            INFO("channel " << k << ": " << mean[std::size_t(k)].against(double(carried[k]))
                            << "; too low: what goes on is to be divided by the probability that it does");
            CHECK(off(mean[std::size_t(k)], double(carried[k])) < 4);
        }
    }
}

TEST_CASE("roulette ends dim paths oftener than bright ones, and black ones at once") {
    Random random(13);
    const auto survivors = [&](vec3 carried) {
        int count = 0;
        for (int i = 0; i < 10'000; ++i) count += roulette(carried, random).has_value();
        return count;
    };
    const int dim = survivors(vec3(0.05f)), middle = survivors(vec3(0.1f, 0.4f, 0.3f)),
              bright = survivors(vec3(0.8f));
    INFO("of 10,000 paths " << dim << " dim, " << middle << " middling and " << bright
                            << " bright ones went on");
    CHECK(dim < middle);
    CHECK(middle < bright);
    CHECK_MESSAGE(dim < 2000, "hardly any path ends: roulette saves no work");
    CHECK(survivors(vec3(0)) == 0);
}

TEST_CASE("unit vectors go to all sides alike, uniform bounces to all sides above the surface") {
    const int samples = 40'000;
    std::array<Mean, 3> mean, square;
    Random random(67);
    for (int i = 0; i < samples; ++i) {
        const vec3 direction = unit_vector(random.uniform2());
        REQUIRE(length(direction) == approx(1));
        for (int k = 0; k < 3; ++k) {
            mean[std::size_t(k)].add(double(direction[k]));
            square[std::size_t(k)].add(double(direction[k] * direction[k]));
        }
    }
    for (std::size_t k = 0; k < 3; ++k) {
        INFO("axis " << k << ": mean " << mean[k].against(0) << "; of the square "
                     << square[k].against(1.0 / 3));
        CHECK(off(mean[k], 0) < 4);
        CHECK(off(square[k], 1.0 / 3) < 4);
    }
    // 8 x 12 cells of equal solid angle: 95 degrees of freedom, above 163.3 once in 50,000.
    for (const vec3 normal : {normals[4], normals[2], normals[8]}) {
        std::vector<double> found(96), even(96, samples / 96.0);
        for (int i = 0; i < samples; ++i) {
            const vec3 direction = bounce_direction(Spread::uniform, normal, random.uniform2());
            const float cosine = dot(direction, normal);
            REQUIRE_MESSAGE(cosine >= 0, "below the surface");
            const int row = std::clamp(int(cosine * 8), 0, 7);
            found[std::size_t(row * 12 + int(azimuth(normal, direction) * 12))] += 1;
        }
        INFO("normal " << to_text(normal) << ": by the cosine would crowd around the normal");
        CHECK(chi_square(found, even) < 163.3);
    }
    CHECK_MESSAGE(bounce_pdf(Spread::uniform, 0.3f) == approx(1 / (2 * pi)), "2 pi directions, all alike");
    CHECK(bounce_pdf(Spread::uniform, -0.3f) == 0);
    CHECK(bounce_pdf(Spread::cosine, 0.3f) == cosine_pdf(0.3f));
}

// ---- metal

TEST_CASE("a metal without fuzz is a mirror") {
    for (const vec3 normal : normals) {
        const Hit hit = facing({1, 2, 3}, normal);
        const vec3 direction = 1.7f * normalize(tangents(normal).u - 0.6f * normal);
        const auto ray =
            metal_ray(Metal{vec3(0.5f)}, {vec3(1, 2, 3) - direction, direction}, hit, {0.3f, 0.8f});
        REQUIRE(ray);
        INFO("normal " << to_text(normal));
        CHECK(normalize(ray->direction) == approx(normalize(reflect(direction, normal))));
        CHECK(ray->origin == approx(offset_position(hit, ray->direction)));
    }
}

TEST_CASE("a fuzzy metal strays evenly around the mirror's direction, and loses what goes into the surface") {
    // On the ball of radius f around the unit mirrored direction, heights are even: with the cosine c of the
    // mirrored ray a share (1 - c / f) / 2 lies below the surface.
    for (const float fuzz : {0.2f, 0.7f, 1.0f})
        for (const float cosine : {0.1f, 0.45f, 0.95f}) {
            const vec3 normal = normals[5];
            const vec3 along = tangents(normal).v;
            const vec3 direction = 2.5f * (std::sqrt(1 - cosine * cosine) * along - cosine * normal);
            const vec3 mirrored = normalize(reflect(direction, normal));
            const Hit hit = facing({1, 2, 3}, normal);
            Mean lost, height, squared;
            Random random(71);
            for (int i = 0; i < 20'000; ++i) {
                const auto ray = metal_ray(Metal{vec3(1), fuzz}, {vec3(1, 2, 3) - direction, direction}, hit,
                                           random.uniform2());
                lost.add(ray ? 0 : 1);
                if (!ray) continue;
                REQUIRE(dot(ray->direction, normal) > 0);
                const vec3 strayed = ray->direction - mirrored;
                height.add(double(dot(strayed, mirrored)));
                squared.add(double(dot(strayed, strayed)));
            }
            const double share_lost = std::max(0.0, (1 - double(cosine / fuzz)) / 2);
            INFO("fuzz " << fuzz << ", cosine " << cosine << ": lost " << lost.against(share_lost)
                         << "; the direction of the incoming ray is to have unit length first");
            CHECK(off(lost, share_lost) < 4);
            CHECK(float(squared.mean()) == approx(fuzz * fuzz, 1e-4f));
            if (share_lost == 0) CHECK(off(height, 0) < 4);
        }
}

TEST_CASE("in a white world a metal shows its albedo, less what its fuzz loses") {
    for (const float fuzz : {0.0f, 0.3f, 1.0f}) {
        Scene scene;
        scene.sky = {vec3(1), vec3(1)};
        scene.quads = {{{-1, -1, -4}, {2, 0, 0}, {0, 2, 0}, add(scene, Metal{vec3(0.8f), fuzz})}};
        const float cosine = 0.25f;
        const vec3 direction(0, std::sqrt(1 - cosine * cosine), -cosine);
        const Mean mean =
            seen(scene, {.depth = 3, .roulette = false}, {vec3(0, 0, -4) - direction, direction});
        const double kept = fuzz > cosine ? 1 - (1 - double(cosine / fuzz)) / 2 : 1;
        INFO("fuzz " << fuzz << ": " << mean.against(0.8 * kept));
        CHECK(off(mean, 0.8 * kept) < 4);
    }
}

// ---- points on lights

TEST_CASE("the points of a light are spread evenly over it") {
    const Quad quad{{1, 2, -1}, {2, 0.5f, 0.3f}, {0.9f, 1, 1.5f}, 0};
    const LightTriangle triangle{{1, 0, 2}, {3, 0.5f, 1}, {0.5f, 2, -1}};
    const Sphere sphere{{-1, 2, 0.5f}, 2.5f, 0};
    // 64 cells of equal area: 63 degrees of freedom, above 120.6 once in 50,000.
    const auto cells = [](auto&& light, const std::function<int(vec3)>& cell_of) {
        std::vector<double> found(64), even(64, 500);
        Random random(17);
        for (int i = 0; i < 32'000; ++i)
            found[std::size_t(std::clamp(cell_of(light_point(light, random.uniform2()).position), 0, 63))] +=
                1;
        return chi_square(found, even);
    };
    CHECK(cells(quad, [&](vec3 p) {
              const vec2 uv = quad_uv(quad, p);
              return int(uv.x * 8) * 8 + int(uv.y * 8);
          }) < 120.6);
    INFO("triangle: u.x for sqrt(u.x) crowds the points at a corner");
    CHECK(
        cells(triangle, [&](vec3 p) { // 8 strips each way, each square of them cut in two: 36 + 28 triangles
            const vec3 b = triangle.b - triangle.a, c = triangle.c - triangle.a, n = cross(b, c);
            const vec2 uv =
                8.0f * vec2(dot(cross(p - triangle.a, c), n), dot(cross(b, p - triangle.a), n)) / dot(n, n);
            const vec2 corner = floor(uv), rest = uv - corner;
            const int row = int(corner.x + corner.y);
            return (rest.x + rest.y < 1 ? 0 : 36) + row * (row + 1) / 2 + int(corner.y);
        }) < 120.6);
    const vec3 axis = normals[5];
    INFO("sphere: an even angle of latitude crowds the points at the poles");
    CHECK(cells(sphere, [&](vec3 p) {
              const vec3 n = (p - sphere.center) / sphere.radius;
              return int((1 + dot(n, axis)) / 2 * 8) * 8 + int(azimuth(axis, n) * 8);
          }) < 120.6);
}

TEST_CASE("the points of a light lie on it, and face along its normal") {
    const Quad quad{{1, 2, -1}, {2, 0.5f, 0.3f}, {0.9f, 1, 1.5f}, 0};
    const LightTriangle triangle{{1, 0, 2}, {3, 0.5f, 1}, {0.5f, 2, -1}};
    const Sphere sphere{{-1, 2, 0.5f}, 2.5f, 0};
    const vec3 quad_normal = cross(quad.edge_u, quad.edge_v);
    const vec3 triangle_normal = cross(triangle.b - triangle.a, triangle.c - triangle.a);
    Mean height; // a uniform direction has the mean cosine 1/2 over a half-sphere
    Random random(19);
    for (int i = 0; i < 3000; ++i) {
        const vec2 u = random.uniform2();
        const LightPoint a = light_point(quad, u), b = light_point(triangle, u), c = light_point(sphere, u);
        const vec2 uv = quad_uv(quad, a.position);
        REQUIRE(min(uv, 1.0f - uv) == approx(max(min(uv, 1.0f - uv), vec2(0))));
        REQUIRE(dot(a.position - quad.corner, quad_normal) == approx(0));
        REQUIRE(std::abs(dot(a.normal, normalize(quad_normal))) == approx(1));
        REQUIRE(dot(b.position - triangle.a, triangle_normal) == approx(0));
        REQUIRE(std::abs(dot(b.normal, normalize(triangle_normal))) == approx(1));
        REQUIRE(distance(c.position, sphere.center) == approx(2.5f));
        REQUIRE(c.position == approx(sphere.center + 2.5f * c.normal));
        height.add(double(std::abs(dot(c.normal, normals[5]))));
    }
    INFO("mean |cosine| of uniform directions, 1/2: " << height.against(0.5));
    CHECK(off(height, 0.5) < 4);
}

TEST_CASE("all that glows is a light, to be picked in proportion to its power") {
    Scene scene;
    const int grey = add(scene, Diffuse{vec3(0.5f)});
    const int red = add(scene, Diffuse{vec3(0.5f), vec3(2, 0, 0)});
    const int white = add(scene, flat(vec3(3)));
    const int coat = add(scene, Reflective{0.25f, white});
    const int picture = add(scene, Textured{add(scene, Bitmap{1, 1, {9000, 9000, 9000}}), vec3(1), vec3(5)});
    scene.quads = {{{0, 0, 0}, {2, 0, 0}, {0, 0, 3}, red},
                   {{0, 5, 0}, {2, 0, 0}, {0, 0, 3}, grey},
                   {{0, 9, 0}, {1, 0, 0}, {0, 0, 2}, picture}};
    scene.spheres = {{{5, 0, 0}, 0.5f, white}, {{9, 0, 0}, 2, grey}};
    add_triangle(scene, {0, 0, 9}, {4, 0, 9}, {0, 1, 9}, coat);
    prepare(scene);
    const AreaLights lights = area_lights(scene);
    REQUIRE(lights.list.size() == 4);
    REQUIRE(lights.cumulative.size() == 4);
    const std::array power{0.2126f * 2 * 6, 5.0f * 2, 3.0f * pi, 0.75f * 3.0f * 2};
    float sum = 0, all = 0;
    for (const float one : power) all += one;
    for (std::size_t i = 0; i < power.size(); ++i) {
        sum += power[i];
        INFO("light "
             << i << ": luminance of the emission times area; a coat of reflectivity k lets 1 - k through");
        CHECK(lights.cumulative[i] == approx(sum / all));
    }
}

// ---- what area lights send

TEST_CASE("a disc above a facing point sends pi L R^2 / (R^2 + h^2)") {
    // R = .5, h = 1: a form factor of .2. The disc is a fan of 360 triangles with the area of the circle.
    Scene scene;
    const int lamp = add(scene, flat(vec3(3)));
    const int sides = 360;
    const double circle = std::sqrt(0.25 * double(pi) / (sides / 2.0 * std::sin(2 * double(pi) / sides)));
    const auto rim = [&](int i) {
        const double angle = 2 * double(pi) * i / sides;
        return vec3(2 + circle * std::cos(angle), 1, -3 + circle * std::sin(angle));
    };
    for (int i = 0; i < sides; ++i) add_triangle(scene, {2, 1, -3}, rim(i), rim(i + 1), lamp);
    const Mean mean = received(scene, {2, 0, -3}, {0, 1, 0}, 100'000);
    INFO("form factor times 3: " << mean.against(0.6));
    INFO(".25 * 3: the solid angle's stand-in pi R^2 / h^2, without the light's or the surface's cosine");
    CHECK(off(mean, 0.6) < 4);
}

TEST_CASE("a point below the middle of a unit square sees it by .2394565") {
    Scene scene;
    scene.quads = {{{-0.5f, 2, 3.5f}, {1, 0, 0}, {0, 0, 1}, add(scene, flat(vec3(1)))}};
    REQUIRE(float(form_factor(corners_of(scene.quads[0]), {0, 1, 4}, {0, 1, 0})) ==
            approx(0.2394565f, 1e-6f));
    const Mean mean = received(scene, {0, 1, 4}, {0, 1, 0}, 100'000);
    INFO(mean.against(0.2394565));
    CHECK(off(mean, 0.2394565) < 4);
}

TEST_CASE("a bright parallelogram sends what Lambert's polygon formula says") {
    Scene scene;
    scene.quads = {{{1, 2, -1}, {2, 0.5f, 0.3f}, {0.9f, 1, 1.5f}, add(scene, flat(vec3(2.5f)))}};
    const vec3 position(0.2f, -0.3f, 0.7f), normal = normalize(vec3(0.8f, 0.9f, 0.1f));
    const double want = 2.5 * form_factor(corners_of(scene.quads[0]), position, normal);
    const Mean mean = received(scene, position, normal, 50'000);
    INFO(mean.against(want));
    INFO("wrong by a constant: the area, or 1 / pi; wrong by the place: a cosine or 1 / r^2");
    CHECK(off(mean, want) < 4);
}

TEST_CASE("a bright triangle sends what Lambert's polygon formula says, from near and far") {
    const std::vector<vec3> triangle{{1, 0.4f, 2}, {3, 0.5f, 1}, {0.5f, 2, -1}};
    const vec3 normal = normalize(vec3(0.6f, 0.7f, 0.3f));
    for (const vec3 position : {vec3(0, 0, 0), vec3(-1, -3, -2), vec3(1.2f, 0.3f, 0.6f) - 0.5f * normal}) {
        Scene scene;
        const int lamp = add(scene, flat(vec3(4)));
        add_triangle(scene, triangle[0], triangle[1], triangle[2], lamp);
        const double want = 4 * form_factor(triangle, position, normal);
        const Mean mean = received(scene, position, normal, 50'000);
        INFO("from " << to_text(position) << ": " << mean.against(want));
        CHECK(off(mean, want) < 4);
    }
}

TEST_CASE("a bright ball sends pi L (R / D)^2 times the cosine") {
    Scene scene;
    scene.spheres = {{{2, 3, -1}, 0.8f, add(scene, flat(vec3(6)))}};
    const vec3 position(0.5f, 0.2f, 0.3f);
    const vec3 normal = normalize(vec3(0.5f, 0.4f, 0.6f));
    const vec3 way = vec3(2, 3, -1) - position;
    const double want = 6 * 0.64 / double(dot(way, way)) * double(dot(normalize(way), normal));
    const Mean mean = received(scene, position, normal, 100'000);
    INFO(mean.against(want) << "; twice as much: the half that faces away is to send nothing");
    CHECK(off(mean, want) < 4);
}

TEST_CASE("a light shines to both sides, and on nothing that faces away from it") {
    const Quad quad{{-1, 2, -0.5f}, {1.5f, 0.2f, 0}, {0.1f, 0, 2}, 0};
    const vec3 below(0.3f, 0.5f, 0.1f), above(0.3f, 3.5f, 0.1f);
    for (const bool under : {true, false}) {
        Scene scene;
        add(scene, flat(vec3(2)));
        scene.quads = {quad};
        const vec3 position = under ? below : above;
        const vec3 normal = normalize(vec3(0.2f, under ? 1.0f : -1.0f, 0.1f));
        const double want = 2 * form_factor(corners_of(quad), position, normal);
        const Mean mean = received(scene, position, normal);
        INFO(std::string(under ? "below: " : "above: ") << mean.against(want));
        CHECK(off(mean, want) < 4);
        CHECK_MESSAGE(received(scene, position, -normal, 1000).mean() == 0,
                      "a cosine below 0 is to count as none");
    }
}

TEST_CASE("several lights of different kind and power add up") {
    Scene scene;
    scene.quads = {{{1, 2, -1}, {2, 0.5f, 0.3f}, {0.9f, 1, 1.5f}, add(scene, flat(vec3(0.5f, 9, 9)))}};
    scene.spheres = {{{-2, 3, -1}, 0.8f, add(scene, flat(vec3(6, 0, 1)))}};
    const std::vector<vec3> triangle{{-1, 4, 2}, {1, 4.5f, 1}, {0.5f, 5, 3}};
    add_triangle(scene, triangle[0], triangle[1], triangle[2], add(scene, flat(vec3(20, 1, 1))));
    const vec3 position(0.2f, -0.3f, 0.7f), normal = normalize(vec3(0.1f, 0.95f, -0.1f));
    const vec3 way = scene.spheres[0].center - position;
    const double want = 0.5 * form_factor(corners_of(scene.quads[0]), position, normal) +
                        6 * 0.64 / double(dot(way, way)) * double(dot(normalize(way), normal)) +
                        20 * form_factor(triangle, position, normal);
    const Mean mean = received(scene, position, normal, 100'000);
    INFO(mean.against(want)
         << "; a third of it, or three times: divide by the probability of the picked light");
    CHECK(off(mean, want) < 4);
}

TEST_CASE("what stands between darkens, what stands beyond does not") {
    const Quad lamp{{-0.5f, 2, -0.5f}, {1, 0, 0}, {0, 0, 1}, 0};
    const vec3 position(0.1f, 0, 0.2f), up(0, 1, 0);
    const double open = 3 * form_factor(corners_of(lamp), position, up);
    const auto with = [&](const std::function<void(Scene&)>& change) {
        Scene scene;
        add(scene, flat(vec3(3)));
        add(scene, Diffuse{vec3(0.5f)});
        scene.quads = {lamp};
        change(scene);
        return received(scene, position, up);
    };
    const Mean hidden = with([](Scene& s) { s.quads.push_back({{-3, 1, -3}, {6, 0, 0}, {0, 0, 6}, 1}); });
    INFO("light through a board: area lights cast shadows too");
    CHECK(hidden.mean() == 0);
    const Mean ceiling = with([](Scene& s) {
        s.quads.push_back({{-3, 2.002f, -3}, {6, 0, 0}, {0, 0, 6}, 1});
    });
    INFO("a ceiling 2 mm above the lamp: " << ceiling.against(open) << "; the shadow ray ends at the lamp");
    CHECK(off(ceiling, open) < 4);
    // A board edge above the point hides the half x > .1 of the lamp.
    const Mean half = with([](Scene& s) { s.quads.push_back({{0.1f, 1, -3}, {6, 0, 0}, {0, 0, 6}, 1}); });
    const double left =
        3 *
        form_factor({{-0.5f, 2, -0.5f}, {0.1f, 2, -0.5f}, {0.1f, 2, 0.5f}, {-0.5f, 2, 0.5f}}, position, up);
    INFO("half hidden: " << half.against(left));
    CHECK(off(half, left) < 4);
}

TEST_CASE("a scene without area lights gets none of their light") {
    Scene scene;
    scene.spheres = {{{0, 3, 0}, 1, add(scene, Diffuse{vec3(0.5f)})}};
    CHECK(received(scene, {0, 0, 0}, {0, 1, 0}, 100).mean() == 0);
}

// ---- two ways to find a lamp

TEST_CASE("the shares of two ways to find the same light add up to one") {
    const float most = std::numeric_limits<float>::max();
    for (const float p : {1e-30f, 1e-6f, 0.3f, 1.0f, 7.0f, 1e9f, most})
        for (const float q : {1e-30f, 1e-6f, 0.2f, 1.0f, 50.0f, 1e9f, most}) {
            INFO("densities " << p << " and " << q << ": " << share(p, q) << " and " << share(q, p));
            REQUIRE(share(p, q) + share(q, p) == approx(1, 1e-6f));
        }
    CHECK_MESSAGE(share(3, 0) == 1, "alone, a way gets all");
    CHECK_MESSAGE(share(3, 1) == approx(0.9f), "3^2 / (3^2 + 1^2); 3/4 would be the balance heuristic");
    CHECK(share(1e-3f, most) == 0);
}

TEST_CASE("the density of a direction towards lamps is that with which they are picked") {
    // The mean of 1 / p(w) over picked points is the solid angle that they fill, front and back.
    Scene scene;
    scene.quads = {{{1, 2, -1}, {2, 0.5f, 0.3f}, {0.9f, 1, 1.5f}, add(scene, flat(vec3(0.5f, 9, 9)))}};
    scene.spheres = {{{-2, 3, -1}, 0.8f, add(scene, flat(vec3(6, 0, 1)))}};
    const std::array<vec3, 3> triangle{vec3(-1, 4, 2), vec3(1, 4.5f, 1), vec3(0.5f, 5, 3)};
    add_triangle(scene, triangle[0], triangle[1], triangle[2], add(scene, flat(vec3(20, 1, 1))));
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
                          2 * 2 * double(pi) * (1 - std::sqrt(1 - 0.64 / (reach * reach))), // both its sides
                          angle(triangle[0], triangle[1], triangle[2])};
    const AreaLights lights = area_lights(scene);
    std::array<Mean, 3> mean;
    Random random(73);
    for (int i = 0; i < 60'000; ++i) {
        const LightPoint point = light_point(lights, random.uniform2());
        const vec3 way = point.position - from;
        const float cosine = dot(normalize(way), point.normal);
        const double inverse = 1 / double(light_pdf(lights, point.emission, length(way), cosine));
        const std::size_t which = point.emission.x == 0.5f ? 0 : point.emission.x == 6 ? 1 : 2;
        for (std::size_t k = 0; k < 3; ++k) mean[k].add(k == which ? inverse : 0);
    }
    for (std::size_t k = 0; k < 3; ++k) {
        INFO("light " << k << " (quad, ball, triangle) fills " << mean[k].against(want[k]));
        INFO("wrong by a constant: the area or the power; by the place: the distance or the cosine");
        CHECK(off(mean[k], want[k]) < 4);
    }
    CHECK_MESSAGE(std::isfinite(light_pdf(lights, vec3(1), 1, 0)), "a lamp seen edge-on");
    CHECK_MESSAGE(light_pdf(AreaLights{}, vec3(1), 1, 0.5f) == 0, "no lamp, no density");
}

TEST_CASE("near a large lamp, however it is looked for, the same light arrives") {
    // A floor point close below a lamp that fills much of its sky: quad, triangle or ball.
    const vec3 position(0.2f, 0, 0.3f), up(0, 1, 0);
    const std::vector<vec3> triangle{{-2, 0.3f, -1}, {2.5f, 0.5f, -1.5f}, {0.2f, 0.4f, 3}};
    for (int kind = 0; kind < 3; ++kind) {
        Scene scene;
        const int lamp = add(scene, flat(vec3(3)));
        scene.planes = {{{0, 0, 0}, up, add(scene, Diffuse{vec3(0.6f)})}};
        double factor = 0;
        if (kind == 0) {
            scene.quads = {{{-1.5f, 0.4f, -1.5f}, {3, 0.3f, 0}, {0, 0.1f, 3}, lamp}};
            factor = form_factor(corners_of(scene.quads[0]), position, up);
        } else if (kind == 1) {
            add_triangle(scene, triangle[0], triangle[1], triangle[2], lamp);
            factor = form_factor(triangle, position, up);
        } else {
            scene.spheres = {{{0.5f, 1.3f, 0.1f}, 1, lamp}};
            const vec3 way = scene.spheres[0].center - position;
            factor = double(dot(normalize(way), up)) / double(dot(way, way));
        }
        for (const Direct direct : all_ways)
            for (const Spread spread : {Spread::cosine, Spread::uniform}) {
                const Transport transport{1, true, direct, false, spread};
                const Mean mean =
                    seen(scene, transport, {position + vec3(-9, 0.5f, 0), vec3(9, -0.5f, 0)}, 40'000);
                INFO((kind == 0   ? "quad, "
                      : kind == 1 ? "triangle, "
                                  : "ball, ")
                     << words(transport) << ": " << mean.against(0.6 * 3 * factor));
                INFO("with both ways too bright or too dark: their shares do not add up, or one has "
                     "another's density");
                CHECK(off(mean, 0.6 * 3 * factor) < 4);
            }
    }
}

TEST_CASE("both ways together are less noisy than either, near a lamp and far from it") {
    // A large lamp just above the floor, where asking is bad, and a small one far above, where chance is bad.
    const auto variance = [](bool both, Direct direct) {
        Scene scene;
        scene.planes = {{{0, 0, 0}, {0, 1, 0}, add(scene, Diffuse{vec3(0.6f)})}};
        scene.quads = {{{-1.5f, 0.15f, -1.5f}, {3, 0.2f, 0}, {0, 0.1f, 3}, add(scene, flat(vec3(1)))}};
        if (both) {
            scene.quads[0] = {{0.25f, 0.05f, -1.5f}, {1.5f, 1.2f, 0}, {0, 0, 3}, scene.quads[0].material};
            scene.quads.push_back({{-1, 4, 0}, {0.3f, 0, 0}, {0, 0, 0.3f}, add(scene, flat(vec3(40)))});
        }
        const Transport transport{1, true, direct, false};
        return seen(scene, transport, {vec3(-9, 0.2f, 0.3f), vec3(9.2f, -0.2f, 0)}, 40'000).variance();
    };
    for (const bool both : {false, true}) {
        const double mis = variance(both, Direct::mis);
        const double lights = variance(both, Direct::lights), bounces = variance(both, Direct::bounces);
        INFO("variance " << mis << " with both, " << lights << " asked, " << bounces << " by chance");
        CHECK(mis < 0.9 * lights);
        if (both) CHECK(mis < 0.9 * bounces);
    }
}

// ---- the walk, in closed form

TEST_CASE("a closed furnace reads Le (1 - rho^(k+1)) / (1 - rho) after k bounces") {
    // Without roulette there is no noise at all.
    const vec3 albedo(0.8f, 0.5f, 0.4f), emission(1, 1, 2.5f);
    const Scene scene = ball_room(albedo, emission);
    const AreaLights lights = area_lights(scene);
    for (const Direct direct : all_ways)
        for (const int depth : {0, 1, 2, 5, 60}) {
            const Transport transport{depth, true, direct, false};
            const vec3 want = emission * (1.0f - pow(albedo, vec3(float(depth + 1)))) / (1.0f - albedo);
            Random random(23);
            for (int i = 0; i < 30; ++i) {
                const vec3 got = radiance(scene, lights, transport, in_ball_room, random);
                INFO(words(transport) << ": expected " << to_text(want) << ", got " << to_text(got));
                INFO("0 at depth 0: the emission of the first hit; 1.2 times too bright or more: light "
                     "counted twice; "
                     "pi times: 1 / pi; one bounce more or less: where the depth is counted");
                REQUIRE(got == approx(want, 2e-4f));
            }
            if (depth == 5) CHECK(want.x == approx(3.68928f));
            if (depth == 60) CHECK(want == approx(vec3(5, 2, 2.5f / 0.6f), 1e-4f));
        }
}

TEST_CASE("roulette leaves a furnace at Le / (1 - rho)") {
    const auto check = [](float rho, int depth, double want) {
        for (const Direct direct : all_ways) {
            Scene scene = ball_room(vec3(rho), vec3(1));
            const Transport transport{depth, true, direct, true};
            const Mean mean = seen(scene, transport, in_ball_room);
            INFO("rho " << rho << ", " << words(transport) << ": " << mean.against(want)
                        << "; too dark: survivors are to be divided by their probability");
            CHECK(off(mean, want) < 4);
        }
    };
    check(0.5f, 60, 2); // .8^61 is a millionth
    check(0.8f, 60, 5);
    check(0.8f, 5, 3.68928);
}

TEST_CASE("without indirect light a furnace reads its own light and one bounce") {
    const Scene scene = ball_room(vec3(0.8f, 0.5f, 0.4f), vec3(1, 2, 3));
    const AreaLights lights = area_lights(scene);
    for (const Direct direct : all_ways)
        for (const bool with_roulette : {false, true})
            for (const int depth : {0, 1, 7}) {
                const Transport transport{depth, false, direct, with_roulette};
                const vec3 want = vec3(1, 2, 3) * (depth == 0 ? vec3(1) : vec3(1.8f, 1.5f, 1.4f));
                Random random(29);
                const vec3 got = radiance(scene, lights, transport, in_ball_room, random);
                INFO(words(transport));
                CHECK(got == approx(want, 2e-4f));
            }
}

TEST_CASE("a white ball in a white world cannot be seen") {
    Scene scene;
    scene.sky = {vec3(0.5f, 1, 2), vec3(0.5f, 1, 2)};
    scene.spheres = {{{1, 2, -3}, 2, add(scene, Diffuse{vec3(1)})}};
    prepare(scene);
    Random random(31);
    for (int i = 0; i < 2000; ++i) {
        const vec3 aim =
            vec3(1, 2, -3) + 4.5f * (vec3(random.uniform(), random.uniform(), random.uniform()) - 0.5f);
        const Ray ray{{4, -1, 5}, 2.0f * (aim - vec3(4, -1, 5))};
        const vec3 got = radiance(scene, AreaLights{}, {.depth = 1, .roulette = false}, ray, random);
        INFO("got " << to_text(got)
                    << "; 1 / pi or pi times: the pi of Lambert; 2/3: the cosine is there twice");
        REQUIRE(got == approx(vec3(0.5f, 1, 2)));
    }
}

TEST_CASE("nothing that is white, mirroring or clear can be seen in a white world") {
    Scene scene;
    scene.sky = {vec3(1), vec3(1)};
    const int white = add(scene, Diffuse{vec3(1)});
    const int glass = add(scene, Glass{{1.5f}});
    const int mirror = add(scene, Mirror{});
    const int coat = add(scene, Reflective{0.4f, white});
    const int bubble = add(scene, Glass{{1.0f}, {1.5f}});
    scene.planes = {{{0, 0, 0}, normalize(vec3(0.1f, 1, 0.2f)), white}};
    scene.spheres = {{{0, 2, 0}, 1, glass},
                     {{0.2f, 2.1f, 0.1f}, 0.4f, bubble},
                     {{2, 2, 0}, 0.9f, mirror},
                     {{-2, 2, 1}, 0.8f, coat}};
    scene.quads = {{{-3, 1, -3}, {6, 0.5f, 0}, {0, 4, 1}, white}};
    prepare(scene);
    Random random(37);
    for (int i = 0; i < 4000; ++i) {
        const vec3 aim =
            6.0f * vec3(random.uniform(), 0.1f + 0.6f * random.uniform(), random.uniform()) - vec3(3, 0, 3);
        const Ray ray{{0.5f, 3, 8}, aim - vec3(0.5f, 3, 8)};
        const vec3 got = radiance(scene, AreaLights{}, {.depth = 5000, .roulette = false}, ray, random);
        INFO("towards " << to_text(aim) << " came " << to_text(got)
                        << "; too dark: a random choice weighed by its share as well as picked by it");
        REQUIRE(got == approx(vec3(1), 1e-4f));
    }
}

TEST_CASE("the sky L = cos theta comes back from the ground as 2 rho / 3") {
    Scene scene;
    scene.sky = {vec3(-1), vec3(1)}; // L = y
    scene.planes = {{{0, -1, 0}, {0, 1, 0}, add(scene, Diffuse{vec3(0.6f)})}};
    for (const bool with_roulette : {false, true}) {
        const Mean mean = seen(scene, {.depth = 3, .roulette = with_roulette}, {{0, 1, 0}, {1, -1, 2}});
        INFO(mean.against(0.4) << "; .3 rho / .6: uniform directions with the density of cosine ones");
        CHECK(off(mean, 0.4) < 4);
    }
}

TEST_CASE("slopes receive of a graded sky what is in front of them") {
    // E = pi mix(nadir, zenith, 1/2 + n.y / 3): a furnace sees energy, this sees direction.
    for (const vec3 normal : {normalize(vec3(1, 2, -2)), normalize(vec3(-0.4f, -0.2f, 0.7f)), vec3(0, 0, -1),
                              vec3(1, 0, 0), normalize(vec3(0.1f, -1, 0.1f))}) {
        Scene scene;
        scene.sky = {vec3(0.2f), vec3(3)};
        scene.planes = {{{1, 2, 3}, normal, add(scene, Diffuse{vec3(0.7f)})}};
        const vec3 along = normalize(cross(normal, vec3(0.3f, 0.5f, 0.1f)));
        const Mean mean = seen(scene, {.depth = 2}, {vec3(1, 2, 3) + 2.0f * normal + along, -normal - along});
        const double want = 0.7 * (0.2 + (3 - 0.2) * (0.5 + double(normal.y) / 3));
        INFO("normal " << to_text(normal) << ": " << mean.against(want));
        CHECK(off(mean, want) < 4);
    }
}

TEST_CASE("found by chance, a bright ball sends as much as when it is asked") {
    // The lamp is small and bright: what clamps its rare, large samples loses their light.
    for (const Direct direct : all_ways) {
        Scene scene;
        const int floor = add(scene, Diffuse{vec3(0.6f)});
        scene.planes = {{{0, 0, 0}, normalize(vec3(0.2f, 1, -0.1f)), floor}};
        scene.spheres = {{{1, 2, -1.5f}, 0.3f, add(scene, flat(vec3(500)))}};
        const vec3 normal = scene.planes[0].normal, way(1, 2, -1.5f);
        const double want = 0.6 * 500 * 0.09 / double(dot(way, way)) * double(dot(normalize(way), normal));
        const Transport transport{1, true, direct, false};
        const Mean mean = seen(scene, transport, {{-3, 2, 2}, {3, -2, -2}}, 60'000);
        INFO(words(transport) << ": " << mean.against(want));
        CHECK(off(mean, want) < 4);
    }
}

TEST_CASE("a lamp is as bright as its emission, with its own reflection of other light on top") {
    Scene scene;
    scene.quads = {{{-1, -1, -4}, {2, 0, 0.5f}, {0, 2, 0}, add(scene, flat(vec3(17, 12, 7)))}};
    prepare(scene);
    for (const Direct direct : all_ways)
        for (const int depth : {0, 1, 5}) {
            Random random(41);
            const vec3 got = radiance(scene, area_lights(scene), {.depth = depth, .direct = direct},
                                      {{0, 0, 0}, {0.1f, 0.1f, -1}}, random);
            CHECK_MESSAGE(got == approx(vec3(17, 12, 7)),
                          "black: emission is to be added where the eye meets the lamp");
        }
}

TEST_CASE("point lights light the first surface as they do in step 02") {
    Scene scene;
    const int floor = add(scene, Diffuse{{0.8f, 0.4f, 0.2f}});
    const int ball = add(scene, Diffuse{{0.3f, 0.5f, 0.7f}});
    const int tiles = add(scene, Checker{vec3(0.7f), {0.2f, 0.1f, 0.3f}, 0.8f});
    scene.planes = {{{0, 0, 0}, normalize(vec3(0.1f, 1, 0.2f)), floor}, {{0, 0, -6}, {0, 0, 1}, tiles}};
    scene.spheres = {{{0, 1, 0}, 0.8f, ball}, {{2, 1.5f, -1}, 0.5f, ball}};
    scene.lights = {{{3, 4, 2}, {50, 40, 30}}, {{-4, 2, 1}, {5, 10, 20}}};
    prepare(scene);
    Random random(43);
    for (int i = 0; i < 3000; ++i) {
        const vec3 aim =
            7.0f * (vec3(random.uniform(), random.uniform(), random.uniform()) - vec3(0.5f, 0.3f, 0.8f));
        const Ray ray{{0, 3, 7}, aim - vec3(0, 3, 7)};
        const auto hit = intersect(scene, ray);
        vec3 want(0);
        if (hit) {
            const Material& material = scene.materials[std::size_t(hit->material)];
            const Diffuse* diffuse = std::get_if<Diffuse>(&material);
            want = lit(scene, *hit, diffuse ? *diffuse : at(std::get<Checker>(material), hit->uv));
        }
        const vec3 got =
            radiance(scene, AreaLights{}, {.depth = 1, .direct = all_ways[std::size_t(i % 3)]}, ray, random);
        INFO("towards " << to_text(aim) << ": expected " << to_text(want) << ", got " << to_text(got));
        REQUIRE(got == approx(want));
    }
}

TEST_CASE("pictures and tiles give the walk their albedo, pictures their light too") {
    // In a white world a flat thing alone shows its albedo, whatever way the bounce goes.
    Scene scene;
    scene.sky = {vec3(1), vec3(1)};
    const int picture = add(scene, Bitmap{1, 1, {65535, 32896, 13107}}); // 255, 128 and 51 of 255
    const int textured = add(scene, Textured{picture, vec3(0.5f), vec3(3, 0, 1)});
    const Checker checker{vec3(0.7f), {0.2f, 0.1f, 0.3f}, 0.8f};
    Scene tiled = scene;
    tiled.planes = {{{0, -2, 0}, {0, 1, 0}, add(tiled, checker)}};
    scene.quads = {{{-1, -1, -4}, {2, 0, 0.5f}, {0, 2, 0}, textured}};
    prepare(scene);
    prepare(tiled);
    Random random(47);
    for (int i = 0; i < 200; ++i) {
        const Transport transport{1 + i % 3, true, all_ways[std::size_t(i % 3)], false};
        const vec3 card =
            radiance(scene, area_lights(scene), transport, {{0, 0, 0}, {0.1f, 0.1f, -1}}, random);
        REQUIRE(card == approx(vec3(3, 0, 1) + 0.5f * vec3(1, 0.2158605f, 0.0331048f)));
        // u along x and v along -z, from the plane's point.
        const Ray down{{0, 0, 0}, {0.1f * float(i % 20), -1, 0.07f * float(i % 13)}};
        const vec3 tile = at(checker, {2 * down.direction.x, -2 * down.direction.z}).albedo;
        REQUIRE(radiance(tiled, AreaLights{}, transport, down, random) == approx(tile));
    }
}

TEST_CASE("a coat of reflectivity k shows k of the mirror and 1 - k of what lies beneath") {
    for (const float k : {0.0f, 0.3f, 0.85f, 1.0f}) {
        Scene once;
        once.sky = {vec3(1), vec3(1)};
        const int base = add(once, Diffuse{vec3(0.4f), vec3(2)});
        const int coat = add(once, Reflective{k, base, vec3(0.9f)});
        const int second = add(once, Reflective{0.5f, coat, vec3(0.6f)});
        Scene twice = once;
        once.quads = {{{-1, -1, -4}, {2, 0, 0.5f}, {0, 2, 0}, coat}};
        twice.quads = {{{-1, -1, -4}, {2, 0, 0.5f}, {0, 2, 0}, second}};
        const double one = double(k) * 0.9 + (1 - double(k)) * (2 + 0.4);
        const double two = 0.5 * 0.6 + 0.5 * one;
        for (const Direct direct : all_ways) {
            const Transport transport{3, true, direct, false};
            const Ray ray{{0, 0, 0}, {0.1f, 0.1f, -1}};
            const Mean single = seen(once, transport, ray), both = seen(twice, transport, ray);
            INFO("k = " << k << ": " << single.against(one)
                        << "; k counted twice, as a weight and as a chance?");
            CHECK(off(single, one) < 4);
            INFO("under a second coat: " << both.against(two));
            CHECK(off(both, two) < 4);
        }
        CHECK(emission(once, coat) == approx(vec3((1 - k) * 2)));
        CHECK(emission(once, second) == approx(vec3(0.5f * (1 - k) * 2)));
    }
}

TEST_CASE("a coated lamp lights its surroundings as if it were 1 - k as bright") {
    for (const Direct direct : all_ways) {
        Scene scene;
        const int floor = add(scene, Diffuse{vec3(0.6f)});
        const int coat = add(scene, Reflective{0.25f, add(scene, flat(vec3(8)))});
        scene.planes = {{{0, 0, 0}, {0, 1, 0}, floor}};
        scene.quads = {{{-0.5f, 2, -1}, {1, 0.2f, 0}, {0, 0, 2}, coat}};
        // The mirror's half of a bounce goes to the sky, which is black, or past the lamp to the floor.
        const vec3 position(0.2f, 0, 0.3f);
        const double want = 0.6 * 6 * form_factor(corners_of(scene.quads[0]), position, {0, 1, 0});
        const Transport transport{1, true, direct, false};
        const Mean mean = seen(scene, transport, {position + vec3(-2, 1, 1), vec3(2, -1, -1)}, 40'000);
        INFO(words(transport) << ": " << mean.against(want));
        CHECK(off(mean, want) < 4);
    }
}

// ---- mirrors and glass in the walk

TEST_CASE("the depth counts mirrors: k of them leave s^k, and one fewer leaves nothing") {
    // Two facing mirrors one metre apart; the ray climbs by a metre between two bounces and leaves after
    // three.
    Scene scene;
    const int mirror = add(scene, Mirror{{0.9f, 0.5f, 1}});
    scene.quads = {{{0, 0, -5}, {0, 3.2f, 0}, {0, 0, 10}, mirror},
                   {{1, 0, -5}, {0, 3.2f, 0}, {0, 0, 10}, mirror}};
    scene.sky = {vec3(2), vec3(2)};
    prepare(scene);
    for (const bool with_roulette : {false, true})
        for (const int depth : {0, 2, 3, 9}) {
            std::array<Mean, 2> mean;
            Random random(53);
            for (int i = 0; i < 4000; ++i) {
                const Transport transport{depth, i % 2 == 0, all_ways[std::size_t(i % 3)], with_roulette};
                const vec3 got =
                    radiance(scene, AreaLights{}, transport, {{0.5f, 0, 0}, {1, 1, 0.2f}}, random);
                mean[0].add(double(got.x));
                mean[1].add(double(got.y));
            }
            const bool through = depth >= 3;
            INFO("depth " << depth << ": " << mean[0].against(through ? 2 * 0.729 : 0));
            CHECK(off(mean[0], through ? 2 * 0.729 : 0) < 4);
            CHECK(off(mean[1], through ? 2 * 0.125 : 0) < 4);
        }
}

TEST_CASE("glass reflects by Fresnel's share") {
    // A ball of radius 2, met at 60 degrees. With one bounce, a path that went in is still in there and dark:
    // what is left of a white world is the reflection, F(60) = .0891867. The direction's length is 1.7.
    Scene scene;
    scene.sky = {vec3(1), vec3(1)};
    scene.spheres = {{{1, 0, 0}, 2, add(scene, Glass{{1.5f}})}};
    const vec3 normal = normalize(vec3(1, 2, -2));
    const vec3 side = normalize(cross(normal, vec3(0, 1, 0)));
    const vec3 direction = -0.5f * normal + std::sqrt(0.75f) * side;
    const Ray ray{vec3(1, 0, 0) + 2.0f * normal - direction, 1.7f * direction};
    const Mean mean = seen(scene, {.depth = 1}, ray, 40'000);
    INFO(mean.against(0.0891867) << "; .0400: the same at all angles, .0700: Schlick's stand-in");
    CHECK(off(mean, 0.0891867) < 4);
}

TEST_CASE("a clear ball in a white furnace reads 1, from outside and from inside") {
    for (const Medium inside : {Medium{1.5f}, Medium{2.417f}, Medium{1.0f}}) {
        Scene scene;
        scene.sky = {vec3(1), vec3(1)};
        scene.spheres = {
            {{1, 0, 0}, 2, add(scene, Glass{inside, inside.ior == 1 ? Medium{1.5f} : Medium{}})}};
        for (const vec3 from : {vec3(4, 3, 5), vec3(1.3f, 0.2f, 1.1f)}) {
            const Mean plain =
                seen(scene, {.depth = 1000, .roulette = false}, {from, {-0.6f, -0.4f, -1}}, 2000);
            CHECK_MESSAGE(float(plain.mean()) == approx(1), "no path is lost and none gains");
            CHECK(plain.variance() < 1e-8);
            const Mean played = seen(scene, {.depth = 1000}, {from, {-0.6f, -0.4f, -1}});
            INFO(played.against(1));
            CHECK(off(played, 1) < 4);
        }
    }
}

TEST_CASE("coloured glass absorbs by the length of the way within it") {
    // Index 1: straight through, so that the chord is known. The direction's length is not 1.
    Scene scene;
    scene.sky = {vec3(2), vec3(2)};
    const vec3 absorption(0.3f, 0.8f, 0);
    const int clear = add(scene, Glass{{1.0f, absorption}});
    const int mirror = add(scene, Mirror{vec3(0.5f)});
    scene.spheres = {{{0, 1, -6}, 2, clear}, {{20, 1, -6}, 2, clear}, {{20, 1, -6}, 0.5f, mirror}};
    prepare(scene);
    Random random(59);
    const Transport transport{.depth = 6, .roulette = false};
    const vec3 direction = 3.0f * normalize(vec3(0.1f, 0.1f, -1));
    const vec3 unit = normalize(direction);
    const float closest = length(vec3(0, 1, -6) - dot(vec3(0, 1, -6), unit) * unit);
    const float chord = 2 * std::sqrt(4 - closest * closest);
    INFO("the chord is " << chord << " long");
    CHECK(radiance(scene, AreaLights{}, transport, {{0, 0, 0}, direction}, random) ==
          approx(2.0f * exp(-absorption * chord), 1e-4f));
    INFO("in to the mirror in the middle, and back out: 2 * 1.5");
    CHECK(radiance(scene, AreaLights{}, transport, {{20, 1, 0}, {0, 0, -2}}, random) ==
          approx(1.0f * exp(-absorption * 3.0f), 1e-4f));
}

TEST_CASE("a matte core in coloured glass is lit through the glass and seen through it") {
    // Core of radius 1 in a ball of radius 2, index 1. In: 1 m. Out, at the angle theta: sqrt(4 - sin^2) -
    // cos.
    Scene scene;
    scene.sky = {vec3(1), vec3(1)};
    const int shell = add(scene, Glass{{1.0f, vec3(0.7f)}});
    scene.spheres = {{{3, 1, -6}, 2, shell}, {{3, 1, -6}, 1, add(scene, Diffuse{vec3(0.8f)})}};
    double out = 0;
    for (int i = 0; i < 10'000; ++i) {
        const double sin2 = (i + 0.5) / 10'000; // of cosine-weighted directions, uniform
        out += std::exp(-0.7 * (std::sqrt(4 - sin2) - std::sqrt(1 - sin2))) / 10'000;
    }
    const double want = std::exp(-0.7) * 0.8 * out;
    const Mean mean = seen(scene, {.depth = 5}, {{3, 1, 0}, {0, 0, -0.5f}});
    INFO(mean.against(want) << "; exp(.7) times brighter: absorption forgotten after the bounce");
    CHECK(off(mean, want) < 4);
}

TEST_CASE("a coloured medium without end lets nothing through") {
    Scene scene;
    scene.sky = {vec3(1), vec3(1)};
    scene.quads = {{{-1, -1, -4}, {2, 0, 0}, {0, 2, 0}, add(scene, Glass{{1.0f, vec3(0.1f)}})}};
    // Seen against its normal's side, the ray goes into the medium and never out of it again.
    const Mean mean = seen(scene, {.depth = 5}, {{0, 0, 0}, {0.1f, 0.1f, -1}}, 100);
    CHECK(mean.mean() == 0);
}

TEST_CASE("a mirror on the wall doubles a lamp: its caustic is neither lost nor counted twice") {
    // The mirror wall x = -1 shows the lamp once more, with its tint, at x -> -2 - x.
    for (const Direct direct : all_ways) {
        Scene scene;
        const int floor = add(scene, Diffuse{vec3(0.6f)});
        const int wall = add(scene, Mirror{vec3(0.7f)});
        scene.planes = {{{0, 0, 0}, {0, 1, 0}, floor}, {{-1, 0, 0}, {1, 0, 0}, wall}};
        const Quad lamp{{0.5f, 1, -1}, {0.4f, 0.8f, 0}, {0.1f, 0, 2}, add(scene, flat(vec3(5)))};
        scene.quads = {lamp};
        const vec3 position(-0.3f, 0, 0.2f), up(0, 1, 0);
        std::vector<vec3> image = corners_of(lamp);
        for (vec3& corner : image) corner.x = -2 - corner.x;
        const double straight = 0.6 * 5 * form_factor(corners_of(lamp), position, up);
        const double caustic = 0.6 * 5 * 0.7 * form_factor(image, position, up);
        const Ray ray{position + vec3(1, 3, 1), vec3(-1, -3, -1)};
        const auto check = [&](const Transport& transport, double want) {
            const Mean mean = seen(scene, transport, ray, 40'000);
            INFO(words(transport) << ": " << mean.against(want) << "; " << straight << " directly, "
                                  << caustic << " by the mirror");
            CHECK(off(mean, want) < 4);
        };
        check({2, true, direct, false}, straight + caustic);
        check({2, true, direct, true}, straight + caustic);
        check({1, true, direct, false}, straight);
    }
}

TEST_CASE("a lamp behind clear glass shines through it, once") {
    // A ball of index 1 around the lamp bends nothing: all its light is a caustic that light sampling cannot
    // see.
    for (const Direct direct : all_ways) {
        Scene scene;
        const int floor = add(scene, Diffuse{vec3(0.6f)});
        const int lamp = add(scene, flat(vec3(5)));
        scene.planes = {{{0, 0, 0}, {0, 1, 0}, floor}};
        scene.quads = {{{-0.5f, 2, -0.5f}, {1, 0.3f, 0}, {0, 0, 1}, lamp}};
        scene.spheres = {{{0, 2.1f, 0}, 1.2f, add(scene, Glass{{1.0f}})}};
        const vec3 position(0.3f, 0, 0.2f);
        const double want = 0.6 * 5 * form_factor(corners_of(scene.quads[0]), position, {0, 1, 0});
        const Transport transport{3, true, direct, false};
        const Mean mean = seen(scene, transport, {position + vec3(-3, 1, 1), vec3(3, -1, -1)}, 40'000);
        INFO(words(transport) << ": " << mean.against(want));
        CHECK(off(mean, want) < 4);
    }
}

// ---- lamps in a mesh

TEST_CASE("triangles with Ke in a mesh's MTL are area lights on both sides") {
    const auto folder = std::filesystem::temp_directory_path() / ("raysteps_08_" + std::to_string(getpid()));
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "box.mtl") << "newmtl glow\nKd .5 .5 .5\nKe 1 2 0\n"
                                         "newmtl lamp\nKd 0 0 0\nKe 6 6 6\nnewmtl grey\nKd .6 .6 .6\n";
    // A box 2 x 1 x 3 that is closed, and by itself a lamp over a floor.
    std::ofstream(folder / "box.obj")
        << "mtllib box.mtl\nv 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 1 0\nv 0 0 3\nv 2 0 3\nv 2 1 3\nv 0 1 3\n"
           "usemtl glow\nf 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 4 8 7 3\nf 1 5 8 4\nf 2 3 7 6\n";
    std::ofstream(folder / "lamp.obj") << "mtllib box.mtl\nv -4 0 -4\nv 4 0 -4\nv 4 0 4\nv -4 0 4\n"
                                          "v -.5 2 -.5\nv .7 2.3 -.4\nv .1 2.1 .8\n"
                                          "usemtl grey\nf 1 4 3 2\nusemtl lamp\nf 5 6 7\n";
    const ObjFile box = read_obj((folder / "box.obj").string());
    const ObjFile lamp = read_obj((folder / "lamp.obj").string());
    std::filesystem::remove_all(folder);

    Scene closed;
    add(closed, box, 30);
    prepare(closed);
    const AreaLights lights = area_lights(closed);
    CHECK_MESSAGE(lights.list.size() == 12, "every triangle that glows is a light of its own");
    Random random(61);
    const Ray inside{{0.7f, 0.4f, 1.2f}, {0.3f, -0.5f, 0.2f}};
    const vec3 chance = radiance(closed, lights, {60, true, Direct::bounces, false}, inside, random);
    INFO("Ke 1, Kd .5, closed: Ke / (1 - Kd) = 2");
    CHECK(chance == approx(vec3(2, 4, 0), 1e-4f));
    const Mean once = seen(closed, {1, true, Direct::lights, false}, inside);
    INFO("lights sampled, one bounce: " << once.against(1.5));
    CHECK(off(once, 1.5) < 4);

    Scene open;
    add(open, lamp, 30);
    const std::vector<vec3> triangle{{-0.5f, 2, -0.5f}, {0.7f, 2.3f, -0.4f}, {0.1f, 2.1f, 0.8f}};
    const double want = 0.6 * 6 * form_factor(triangle, {0.4f, 0, -0.3f}, {0, 1, 0});
    for (const Direct direct : all_ways) {
        const Transport transport{1, true, direct, false};
        const Mean mean = seen(open, transport, {{2.4f, 1, -1.3f}, {-2, -1, 1}}, 40'000);
        INFO("under the lamp, " << words(transport) << ": " << mean.against(want));
        CHECK(off(mean, want) < 4);
    }
    const vec3 above(0.2f, 4, 0.1f);
    const Mean back = received(open, above, {0, -1, 0});
    INFO("above the lamp: " << back.against(6 * form_factor(triangle, above, {0, -1, 0})));
    CHECK(off(back, 6 * form_factor(triangle, above, {0, -1, 0})) < 4);
}
