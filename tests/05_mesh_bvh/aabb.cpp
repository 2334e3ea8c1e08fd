// Facts about boxes: where a ray enters one, also in the plane of a face or along an edge; how boxes grow.
#include "05_mesh_bvh/aabb.h"
#include "tests/05_mesh_bvh/rays.h"
#include "tests/check.h"

using namespace rt;

namespace {

const Aabb box_3x3x2 = {{-1, -2, 3}, {2, 1, 5}};

} // namespace

TEST_CASE("a ray enters a box where it first touches one of its faces") {
    Random random(21);
    for (int i = 0; i < 20000; ++i) {
        const Ray ray{centroid(box_3x3x2) + 6.0f * random_direction(random), random_direction(random)};
        // Independent of slabs: intersect the plane of each face and test whether
        // the point is within the face.
        double first = 1e30, margin = 1e30;
        for (int axis = 0; axis < 3; ++axis) {
            for (const vec3 corner : {box_3x3x2.min, box_3x3x2.max}) {
                const double t =
                    (double(corner[axis]) - double(ray.origin[axis])) / double(ray.direction[axis]);
                const glm::dvec3 p = glm::dvec3(ray.origin) + t * glm::dvec3(ray.direction);
                double within = 1e30;
                for (int other = 0; other < 3; ++other)
                    if (other != axis)
                        within = std::min({within, p[other] - double(box_3x3x2.min[other]),
                                           double(box_3x3x2.max[other]) - p[other]});
                margin = std::min(margin, std::abs(within));
                if (within > 0 && t > 0) first = std::min(first, t);
            }
        }
        if (margin < 1e-4) continue; // through an edge
        const vec3 from_middle = abs(ray.origin - centroid(box_3x3x2));
        const bool starts_inside = from_middle.x < 1.5f && from_middle.y < 1.5f && from_middle.z < 1;
        const auto t = intersect(box_3x3x2, ray);
        if (t.has_value() != (first < 1e30)) {
            FAIL_CHECK("from ", ray.origin, " along ", ray.direction,
                       std::string(t ? ": expected a miss" : ": expected a hit"),
                       " (slabs that do not swap near and far lose every ray with a negative direction)");
        } else if (t && !(*t == approx(starts_inside ? 0 : float(first), 1e-4f))) {
            FAIL_CHECK("from ", ray.origin, " along ", ray.direction, ": expected entry at ", first, ", got ",
                       *t);
        }
    }
}

TEST_CASE("a ray that starts inside a box enters it at t_min") {
    for (const vec3 direction : {vec3(1, 2, 3), vec3(-1, 2, -3), vec3(0, 0, -2), vec3(-0.0f, 1, 0)}) {
        CHECK(intersect(box_3x3x2, Ray{{0, 0, 4}, direction}) == 0.0f);
        CHECK(intersect(box_3x3x2, Ray{{0, 0, 4}, direction, 0.01f, 2}) == 0.01f);
    }
}

TEST_CASE("a box behind the ray, beyond t_max or before t_min is not entered") {
    const vec3 direction{0.1f, -0.2f, -2}; // |d| is about 2: the ray is in the box from t = 2.5 to 3.5
    const vec3 from{0, 0, 10};
    CHECK(intersect(box_3x3x2, Ray{from, direction}) == 2.5f);
    CHECK_MESSAGE(!intersect(box_3x3x2, Ray{from, -direction}),
                  "the box is behind the ray: no error in the image, but much wasted work");
    CHECK_MESSAGE(!intersect(box_3x3x2, Ray{from, direction, 0, 2.4f}),
                  "the box is beyond t_max: no error in the image, but much wasted work");
    CHECK_MESSAGE(!intersect(box_3x3x2, Ray{from, direction, 3.6f, 9}), "the box is before t_min");
    CHECK(intersect(box_3x3x2, Ray{from, direction, 0, 2.6f}).has_value());
    CHECK(intersect(box_3x3x2, Ray{from, direction, 3.4f, 9}) == 3.4f);
}

TEST_CASE("a ray whose direction is zero along an axis misses a box beside it") {
    for (const float t_max : {100.0f, infinity}) {
        for (int axis = 0; axis < 3; ++axis) {
            for (const float zero : {0.0f, -0.0f}) {
                for (const float side : {-1.0f, 1.0f}) {
                    vec3 direction{-0.3f, 0.4f, 0.2f};
                    direction[axis] = zero;
                    vec3 origin = centroid(box_3x3x2) - 4.0f * direction;
                    INFO("axis ", axis, ", direction ", direction, ", t_max ", t_max, ", offset ", side);
                    CHECK(intersect(box_3x3x2, Ray{origin, direction, 0, t_max}).has_value());
                    origin[axis] += side * 2;
                    CHECK_MESSAGE(!intersect(box_3x3x2, Ray{origin, direction, 0, t_max}),
                                  "an entry at infinity is a miss, even if the ray is unbounded");
                }
            }
        }
    }
}

TEST_CASE("a ray in the plane of a face hits the box, whatever the sign of its zero") {
    std::string lost; // axis, plane and sign of those that miss
    for (int axis = 0; axis < 3; ++axis) {
        for (const float zero : {0.0f, -0.0f}) {
            for (const vec3 corner : {box_3x3x2.min, box_3x3x2.max}) {
                for (const vec3 oblique : {vec3(0.3f, 0.5f, -0.4f), vec3(-0.3f, 0.2f, 0.7f)}) {
                    vec3 direction = oblique;
                    direction[axis] = zero;
                    vec3 origin = centroid(box_3x3x2);
                    origin[axis] = corner[axis];
                    if (!intersect(box_3x3x2, Ray{origin - 8.0f * direction, direction}))
                        lost += std::string(1, "xyz"[axis]) + (corner == box_3x3x2.min ? "min" : "max") +
                                (std::signbit(zero) ? "- " : "+ ");
                    INFO("axis ", axis, ", direction ", direction, ", plane at ", corner[axis]);
                    CHECK(intersect(box_3x3x2, Ray{origin, direction}) == 0.0f);
                }
            }
        }
    }
    CHECK_MESSAGE(lost == "", "0 * infinity is NaN: write the comparison so that NaN changes nothing");
}

TEST_CASE("a ray along an edge of a box hits it") {
    for (int axis = 0; axis < 3; ++axis) {
        for (int i = 0; i < 16; ++i) {
            const int next = (axis + 1) % 3, last = (axis + 2) % 3;
            vec3 origin, direction;
            origin[axis] = -20;
            direction[axis] = 2;
            origin[next] = i & 1 ? box_3x3x2.min[next] : box_3x3x2.max[next];
            origin[last] = i & 2 ? box_3x3x2.min[last] : box_3x3x2.max[last];
            direction[next] = i & 4 ? 0.0f : -0.0f;
            direction[last] = i & 8 ? 0.0f : -0.0f;
            INFO("from ", origin, " along ", direction);
            CHECK(intersect(box_3x3x2, Ray{origin, direction}) == (box_3x3x2.min[axis] + 20) / 2);
        }
    }
}

TEST_CASE("a ray aimed at a corner of a box is not lost by rounding") {
    Random random(22);
    int lost = 0;
    for (int i = 0; i < 100000; ++i) {
        const vec3 low = 3.0f * random_point(random), high = low + random_point(random);
        const vec3 corner = {i & 1 ? low.x : high.x, i & 2 ? low.y : high.y, i & 4 ? low.z : high.z};
        const vec3 from = corner + 3.0f * random_direction(random); // most touch the box only there
        lost += !intersect(Aabb{low, high}, Ray{from, corner - from}).has_value();
    }
    CHECK_MESSAGE(lost == 0,
                  "of 100,000: entry and exit differ only by rounding there, so widen the box slightly");
}

TEST_CASE("a box of zero thickness is hit") {
    for (int axis = 0; axis < 3; ++axis) {
        Aabb flat_box = box_3x3x2;
        flat_box.max[axis] = flat_box.min[axis];
        Random random(23);
        int lost = 0, invented = 0;
        for (int i = 0; i < 1000; ++i) {
            const vec3 target = mix(flat_box.min, flat_box.max, 0.001f + 0.998f * random_point(random));
            vec3 origin = target + 3.0f * random_direction(random);
            lost += !intersect(flat_box, Ray{origin, target - origin}).has_value();
            invented += intersect(flat_box, Ray{origin, target - origin, 0, 0.99f}).has_value();
        }
        INFO("flat along axis ", axis);
        CHECK_MESSAGE(lost == 0, "a floor or a wall has such a box: t_near <= t_far, not <");
        CHECK(invented == 0);
        vec3 head_on{0};
        head_on[axis] = -2;
        CHECK(intersect(flat_box, Ray{centroid(flat_box) - 3.0f * head_on, head_on}) == 3.0f);
    }
}

TEST_CASE("a box grows to enclose points and boxes; an empty box encloses nothing") {
    Aabb box;
    CHECK(half_area(box) == 0);
    extend(box, vec3(1, 5, -2));
    CHECK(box.min == vec3(1, 5, -2));
    CHECK(box.max == vec3(1, 5, -2));
    CHECK(half_area(box) == 0);
    extend(box, vec3(3, 2, 2));
    CHECK(box.min == vec3(1, 2, -2));
    CHECK(box.max == vec3(3, 5, 2));
    CHECK(centroid(box) == vec3(2, 3.5f, 0));
    CHECK_MESSAGE(half_area(box) == 26, "2 x 3 x 4: 6 + 12 + 8; 24 is the volume");
    extend(box, Aabb{});
    CHECK(box.min == vec3(1, 2, -2));
    CHECK(box.max == vec3(3, 5, 2));
    extend(box, Aabb{{0, 3, -5}, {2, 9, 1}});
    CHECK(box.min == vec3(0, 2, -5));
    CHECK(box.max == vec3(3, 9, 2));
}
