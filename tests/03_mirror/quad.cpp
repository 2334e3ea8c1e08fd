// Facts about quads: where a ray hits one, how u and v run, and which way it faces.
#include "03_mirror/quad.h"
#include "tests/03_mirror/step.h"

using namespace rt;

namespace {

/// Skewed and oblique, with sides of different lengths.
const Quad quad{{1, -2, 3}, {2, 0.5f, -1}, {-0.3f, 1.2f, 0.7f}, 5};
const vec3 quad_normal = normalize(cross(quad.edge_u, quad.edge_v));

vec3 on_quad(float u, float v) {
    return quad.corner + u * quad.edge_u + v * quad.edge_v;
}

/// Returns an oblique ray from the front that hits this point of the quad at t = 1.5.
Ray to_quad(float u, float v) {
    const vec3 direction = -2.0f * quad_normal + 0.7f * beside(quad_normal);
    return {on_quad(u, v) - 1.5f * direction, direction};
}

} // namespace

TEST_CASE("a quad is hit between its edges and missed beyond them") {
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

TEST_CASE("a quad is hit on both sides of its diagonal") {
    CHECK(intersect(quad, to_quad(0.2f, 0.2f)));
    CHECK_MESSAGE(intersect(quad, to_quad(0.9f, 0.9f)),
                  "u + v > 1 is the other half: without it this would be a triangle");
}

TEST_CASE("t on a quad is measured in multiples of the direction and respects the ray's interval") {
    Ray ray = to_quad(0.4f, 0.7f);
    CHECK(t_of(intersect(quad, ray)) == approx(1.5f));
    CHECK(t_of(intersect(quad, Ray{ray.origin, 2.0f * ray.direction})) == approx(0.75f));
    CHECK_FALSE_MESSAGE(intersect(quad, Ray{ray.origin, -ray.direction}), "the quad is behind the ray");
    CHECK_FALSE_MESSAGE(intersect(quad, Ray{ray.origin, ray.direction, 0, 1.4f}), "the quad is beyond t_max");
    CHECK_FALSE_MESSAGE(intersect(quad, Ray{ray.origin, ray.direction, 1.6f}), "the quad is before t_min");
}

TEST_CASE("a ray parallel to a quad misses it") {
    const Quad flat_quad{{0, 1, 0}, {2, 0, 0}, {0, 0, -3}, 0};
    CHECK_FALSE(intersect(flat_quad, Ray{{-1, 1, -1}, {1, 0, 0}}));
    CHECK_FALSE(intersect(flat_quad, Ray{{-1, 2, -1}, {1, 0, 0.2f}}));
}

TEST_CASE("u and v of a quad run along its edges from the corner") {
    for (const vec2 uv : {vec2(0.25f, 0.75f), vec2(0.9f, 0.1f), vec2(0, 1), vec2(1, 0), vec2(-0.5f, 2)})
        CHECK_MESSAGE(quad_uv(quad, dvec3(on_quad(uv.x, uv.y))) == approx(uv),
                      "u along edge_u and v along edge_v, even if they are not perpendicular");
    const Ray ray = to_quad(0.25f, 0.75f);
    const Hit hit = surface_hit(quad, Ray{ray.origin, ray.direction, 0, 1.5f});
    CHECK(hit.uv == approx(vec2(0.25f, 0.75f)));
    CHECK(hit.position == approx(on_quad(0.25f, 0.75f)));
    CHECK(hit.material == 5);
}

TEST_CASE("a quad faces the cross product of its edges and the normal is flipped for rays from behind") {
    const Ray ray = to_quad(0.4f, 0.7f);
    const Hit front = surface_hit(quad, Ray{ray.origin, ray.direction, 0, 1.5f});
    CHECK(front.shading_normal == approx(quad_normal));
    CHECK_FALSE(front.back_face);
    CHECK(front.geometric_normal == approx(quad_normal));
    const Ray from_behind{at(ray, 3), -ray.direction};
    CHECK(t_of(intersect(quad, from_behind)) == approx(1.5f));
    const Hit back = surface_hit(quad, Ray{from_behind.origin, from_behind.direction, 0, 1.5f});
    CHECK(back.shading_normal == approx(-quad_normal));
    CHECK(back.back_face);
    CHECK(back.uv == approx(vec2(0.4f, 0.7f)));
}
