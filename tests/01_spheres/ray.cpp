// Facts about a ray: how far t goes, and which t it contains.
#include "tests/check.h"

#include "01_spheres/ray.h"

#include "tests/01_spheres/step.h"

using namespace rt;

TEST_CASE("t counts in lengths of the ray's direction") {
    const Ray ray{{1, 2, 3}, {0, -2, 0.5f}};
    CHECK_MESSAGE(at(ray, 3) == approx(vec3(1, -4, 4.5f)),
                  "origin + t direction, with the direction as it is");
    CHECK(at(ray, 0) == approx(vec3(1, 2, 3)));
}

TEST_CASE("a ray contains the t between its ends") {
    const Ray ray{{0, 0, 0}, {0, 0, -1}, 1, 4};
    CHECK(contains(ray, 1.5f));
    CHECK(contains(ray, 3.9f));
    CHECK_FALSE_MESSAGE(contains(ray, 0.5f), "before t_min");
    CHECK_FALSE_MESSAGE(contains(ray, 4.5f), "beyond t_max");
    CHECK_FALSE_MESSAGE(contains(ray, 4), "a hit shortens the ray to its own t, and must not be found again");
    CHECK_FALSE_MESSAGE(contains(ray, miss), "a t that is not a number lies in no interval");
    CHECK_FALSE_MESSAGE(contains(Ray{{0, 0, 0}, {0, 0, -1}}, -1),
                        "what lies behind the origin does not count");
    CHECK(contains(Ray{{0, 0, 0}, {0, 0, -1}}, 1e30f));
}
