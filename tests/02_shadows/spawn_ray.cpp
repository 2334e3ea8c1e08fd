// Facts about leaving a surface: secondary rays start beside it, and a segment ends at its target.
#include "tests/check.h"

#include "02_shadows/spawn_ray.h"

#include "tests/02_shadows/step.h"

using namespace rt;

TEST_CASE("a secondary ray starts beside the surface, on the side that it enters") {
    const Hit hit = hit_at(somewhere, tilted);
    const vec3 out = 3.0f * tilted + 2.0f * beside(tilted);
    const vec3 outside = offset_ray_origin(hit, out) - hit.position;
    const vec3 inside = offset_ray_origin(hit, -out) - hit.position;
    CHECK_MESSAGE(dot(outside, tilted) > 0, "the wrong side, or no offset: shadow acne, salt and pepper");
    CHECK_MESSAGE(dot(inside, tilted) < 0, "a ray that goes through the surface must start behind it");
    CHECK_MESSAGE(length(outside) < 1e-3f, "so far off the surface that shadows detach from their objects");
    CHECK_MESSAGE(length(outside) >= 0.9f * hit.position_error, "less than the error bound of the position");
    CHECK_MESSAGE(length(cross(outside, tilted)) < 1e-6f,
                  "the offset must be along the normal, not along the ray");
}

TEST_CASE("the offset is along the geometric normal and not along the shading normal") {
    const vec3 smooth = normalize(tilted + 0.8f * beside(tilted));
    const vec3 down = -2.0f * tilted;
    const Hit hit = make_hit(Ray{somewhere - down, down, 0, 1}, tilted, smooth, {0, 0}, 0);
    const vec3 step = offset_ray_origin(hit, tilted - 2.0f * beside(tilted)) - hit.position;
    CHECK_MESSAGE(dot(step, tilted) > 0,
                  "the direction leaves the true surface, although it points below the smooth one");
    CHECK(length(cross(step, tilted)) < 0.1f * length(step));
}

TEST_CASE("the offset grows with the coordinates, as their rounding error does") {
    const float near = length(offset_ray_origin(hit_at({1, 0, 0}, tilted), tilted) - vec3(1, 0, 0));
    const float far = length(offset_ray_origin(hit_at({1000, 0, 0}, tilted), tilted) - vec3(1000, 0, 0));
    CHECK_MESSAGE(far > 100 * near, "near the origin " << near << ", at 1000 metres " << far);
    CHECK_MESSAGE(far > 1000 * 0x1p-23f, "less than the rounding error of the position");
    CHECK_MESSAGE(far < 0.1f, "the offset is visible");
}

TEST_CASE("a ray from a hit is unbounded in its direction") {
    const Hit hit = hit_at(somewhere, tilted);
    const Ray ray = spawn_ray(hit, {3, -1, 2});
    CHECK(ray.direction == vec3(3, -1, 2));
    CHECK(ray.t_max == infinity);
    CHECK(distance(ray.origin, somewhere) < 1e-3f);
}

TEST_CASE("a segment ends at its target") {
    const Hit hit = hit_at(somewhere, tilted);
    const vec3 target = somewhere + 5.0f * tilted + 2.0f * beside(tilted);
    const Ray segment = spawn_ray_to(hit, target);
    CHECK_MESSAGE(
        at(segment, segment.t_max) == approx(target),
        "t_max = 1 if the direction is the whole vector to the target, t_max = r if it has unit length");
    CHECK_MESSAGE(distance(at(segment, segment.t_min), somewhere) < 1e-3f,
                  "the segment must start at the hit");
}

TEST_CASE("a segment ends at its target even if its beginning was moved far") {
    const Hit hit = hit_at({1000, 0, 0}, tilted);
    const vec3 target = hit.position + 5.0f * tilted + 2.0f * beside(tilted);
    const Ray segment = spawn_ray_to(hit, target);
    CHECK_MESSAGE(distance(at(segment, segment.t_max), target) < 0.3f * hit.position_error,
                  "beyond the target by the offset: the direction must begin at the moved origin");
    const vec3 behind = hit.position - 5.0f * tilted;
    const Ray inward = spawn_ray_to(hit, behind);
    CHECK_MESSAGE(distance(at(inward, inward.t_max), behind) < 0.3f * hit.position_error,
                  "a target behind the surface is missed by the offset");
}

TEST_CASE("a segment to a target behind the surface begins on the side that the ray came from") {
    const Hit hit = hit_at(somewhere, tilted);
    const Ray segment = spawn_ray_to(hit, somewhere - 5.0f * tilted);
    CHECK_MESSAGE(dot(segment.origin - hit.position, tilted) > 0, "the surface hides what is behind it");
}

TEST_CASE("a long segment begins as close to its hit as a short one") {
    const Hit hit = hit_at(somewhere, tilted);
    const Ray segment = spawn_ray_to(hit, somewhere + 1000.0f * tilted);
    CHECK_MESSAGE(distance(at(segment, segment.t_min), somewhere) < 1e-3f,
                  "t is a share of the segment: a t_min that is not 0 skips what is close to the surface");
}
