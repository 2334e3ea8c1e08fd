// Facts about a hit: the side of its normals, its position, and the error bound of the position.
#include "tests/check.h"

#include "01_spheres/hit.h"
#include "01_spheres/sphere.h"
#include "common/math/random.h"

#include <algorithm>
#include <string>

#include "tests/01_spheres/step.h"

using namespace rt;
using glm::dvec3;

TEST_CASE("both normals of a hit face the side from which the ray comes") {
    const vec3 true_normal = normalize(vec3(1, 2, -2));
    const vec3 smooth = normalize(vec3(1.5f, 2, -2));
    const Ray toward{{5, 5, 5}, {-1, -3, 0.5f}, 0, 2}; // against the normal
    const Hit front = make_hit(toward, true_normal, smooth, {0.3f, 0.6f}, 4);
    CHECK(front.shading_normal == approx(smooth));
    CHECK(front.geometric_normal == approx(true_normal));
    CHECK_FALSE(front.back_face);

    const Ray along{{5, 5, 5}, {1, 3, -0.5f}, 0, 2}; // along the normal: from behind
    const Hit back = make_hit(along, true_normal, smooth, {0.3f, 0.6f}, 4);
    CHECK_MESSAGE(back.shading_normal == approx(-smooth),
                  "not flipped: surfaces seen from behind will be black");
    CHECK_MESSAGE(back.geometric_normal == approx(-true_normal),
                  "not flipped: ray offsets will point the wrong way");
    CHECK_MESSAGE(back.back_face, "d.n > 0 means that the ray leaves the surface");
    for (const Hit& hit : {front, back}) {
        CHECK(hit.uv == approx(vec2(0.3f, 0.6f)));
        CHECK(hit.material == 4);
    }
}

TEST_CASE("the side and the normals of a hit do not depend on where it is") {
    const vec3 true_normal = normalize(vec3(1, 2, -2));
    const auto told = [&](vec3 origin, vec3 direction) {
        const Hit hit = make_hit(Ray{origin, direction, 0, 2}, true_normal, {0, 0}, 0);
        const auto faces = [&](vec3 normal) { return dot(normal, direction) < 0 ? "against" : "along"; };
        return std::string(hit.back_face ? "from behind" : "from the front") + ", shading normal " +
               faces(hit.shading_normal) + ", geometric normal " + faces(hit.geometric_normal);
    };
    for (const float side : {1.0f, -1.0f}) {
        const vec3 origin = side * vec3(5, 5, -5);
        CHECK(told(origin, {-1, -3, 0.5f}) ==
              "from the front, shading normal against, geometric normal against");
        CHECK(told(origin, {1, 3, -0.5f}) == "from behind, shading normal against, geometric normal against");
    }
}

TEST_CASE("the geometric normal decides on which side a ray is and not the shading normal") {
    const Hit hit =
        make_hit(Ray{{0, 0, 0}, {1, -0.1f, 0}, 0, 2}, {0, 1, 0}, normalize(vec3(0.4f, 1, 0)), {0, 0}, 0);
    CHECK_FALSE_MESSAGE(hit.back_face,
                        "at a grazing angle an interpolated normal may point away from the ray");
    CHECK(hit.geometric_normal == approx(vec3(0, 1, 0)));
}

TEST_CASE("a hit lies at the end of its ray") {
    const Hit hit = make_hit(Ray{{1, 2, 3}, {-2, 0.5f, 4}, 0.5f, 3}, {0, 1, 0}, {0, 0}, 0);
    CHECK(hit.t == 3);
    CHECK(hit.position == approx(vec3(-5, 3.5f, 15)));
}

TEST_CASE("the error bound of a hit's position holds near and far from the origin") {
    Random random(4);
    double worst = 0;
    for (int i = 0; i < 10000; ++i) {
        const float scale = std::pow(10.0f, -2 + 6 * random.get_1d()); // 1 cm to 10 km
        const Sphere sphere{any_point(random, scale), scale * (0.1f + random.get_1d()), 0};
        Ray ray{any_point(random, 3 * scale), any_direction(random)};
        const auto t = intersect(sphere, ray);
        if (!t) continue;
        ray.t_max = *t;
        const Hit hit = surface_hit(sphere, ray);
        const double off =
            std::abs(length(dvec3(hit.position) - dvec3(sphere.center)) - double(sphere.radius));
        worst = std::max(worst, off / double(hit.position_error));
        if (!(hit.position_error > 0 && hit.position_error < 1e-4f * 3 * scale)) worst = infinity;
    }
    CHECK_MESSAGE(
        worst < 1,
        "worst error as a fraction of hit.position_error (infinity: the bound is 0 or large enough to see)");
}
