// Facts about metals: the directions of scattered rays, and the rays that are lost.
// Statistical checks are z-tests with fixed seeds; a correct renderer exceeds |z| =
// 4 in one run out of 16,000.
#include "08_indirect/metal.h"
#include "tests/08_indirect/step.h"
#include "tests/check.h"

#include <algorithm>
#include <cmath>

using namespace rt;

TEST_CASE("a metal with fuzz 0 is a mirror") {
    for (const vec3 normal : normals) {
        const Hit hit = facing({1, 2, 3}, normal);
        const vec3 direction = 1.7f * normalize(make_basis(normal).u - 0.6f * normal);
        const auto ray =
            scatter_metal(Metal{vec3(0.5f)}, {vec3(1, 2, 3) - direction, direction}, hit, {0.3f, 0.8f});
        REQUIRE(ray);
        INFO("normal " << to_text(normal));
        CHECK(normalize(ray->direction) == approx(normalize(reflect(direction, normal))));
        CHECK(ray->origin == approx(offset_ray_origin(hit, ray->direction)));
    }
}

TEST_CASE("on a smooth mesh too no ray goes into the surface") {
    Hit hit = facing({1, 2, 3}, normals[5]);
    hit.shading_normal = normalize(hit.geometric_normal + 0.7f * make_basis(hit.geometric_normal).u);
    const vec3 direction = -normalize(hit.geometric_normal - 0.3f * make_basis(hit.geometric_normal).u);
    Random random(73);
    int left = 0, entering = 0;
    for (int i = 0; i < 2000; ++i) {
        const auto ray =
            scatter_metal(Metal{vec3(1), 0.9f}, {hit.position - direction, direction}, hit, random.get_2d());
        if (!ray) continue;
        ++left;
        entering += dot(ray->direction, hit.geometric_normal) <= 0;
    }
    CHECK_MESSAGE(entering == 0, "the true normal decides whether the ray enters the surface");
    CHECK(left > 500);
}

TEST_CASE(
    "a fuzzy metal scatters evenly around the mirror direction, and loses rays that enter the surface") {
    // On the sphere of radius f around the unit mirror direction, heights are uniform: if the mirror ray has
    // the cosine c, a share of (1 - c / f) / 2 is below the surface.
    for (const float fuzz : {0.2f, 0.7f, 1.0f})
        for (const float cosine : {0.1f, 0.45f, 0.95f}) {
            const vec3 normal = normals[5];
            const vec3 along = make_basis(normal).v;
            const vec3 direction = 2.5f * (std::sqrt(1 - cosine * cosine) * along - cosine * normal);
            const vec3 mirrored = normalize(reflect(direction, normal));
            const Hit hit = facing({1, 2, 3}, normal);
            Mean lost, height, squared;
            Random random(71);
            for (int i = 0; i < 20'000; ++i) {
                const auto ray = scatter_metal(Metal{vec3(1), fuzz}, {vec3(1, 2, 3) - direction, direction},
                                               hit, random.get_2d());
                lost.add(ray ? 0 : 1);
                if (!ray) continue;
                REQUIRE(dot(ray->direction, normal) > 0);
                const vec3 strayed = ray->direction - mirrored;
                height.add(double(dot(strayed, mirrored)));
                squared.add(double(dot(strayed, strayed)));
            }
            const double share_lost = std::max(0.0, (1 - double(cosine / fuzz)) / 2);
            INFO("fuzz " << fuzz << ", cosine " << cosine << ": lost " << lost.against(share_lost)
                         << "; the incoming direction must be normalised first");
            CHECK(off(lost, share_lost) < 4);
            CHECK(float(squared.mean()) == approx(fuzz * fuzz, 1e-4f));
            if (share_lost == 0) CHECK(off(height, 0) < 4);
        }
}
