// Facts about a ray: the unit of t, and the interval of t that it contains.
#include "tests/check.h"

#include "01_spheres/ray.h"

#include "tests/01_spheres/step.h"

using namespace rt;

TEST_CASE("t is measured in multiples of the ray's direction") {
    const Ray ray{{1, 2, 3}, {0, -2, 0.5f}};
    CHECK_MESSAGE(at(ray, 3) == approx(vec3(1, -4, 4.5f)),
                  "must be origin + t direction, with the direction unnormalised");
    CHECK(at(ray, 0) == approx(vec3(1, 2, 3)));
}

TEST_CASE("a ray contains the t between its ends") {
    const Ray ray{{0, 0, 0}, {0, 0, -1}, 1, 4};
    CHECK(contains(ray, 1.5f));
    CHECK(contains(ray, 3.9f));
    CHECK_FALSE_MESSAGE(contains(ray, 0.5f), "before t_min");
    CHECK_FALSE_MESSAGE(contains(ray, 4.5f), "beyond t_max");
    CHECK_FALSE_MESSAGE(contains(ray, 4), "a hit shortens the ray to its own t and must not be found again");
    CHECK_FALSE_MESSAGE(contains(ray, miss), "no interval contains a t that is NaN");
    CHECK_FALSE_MESSAGE(contains(Ray{{0, 0, 0}, {0, 0, -1}}, -1),
                        "what lies behind the origin does not count");
    CHECK(contains(Ray{{0, 0, 0}, {0, 0, -1}}, 1e30f));
}
