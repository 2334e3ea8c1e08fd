// Facts about ray-triangle intersection: on both sides, at any size, at the edges.
#include "05_mesh_bvh/triangle.h"
#include "tests/05_mesh_bvh/rays.h"
#include "tests/check.h"

using namespace rt;

namespace {

const vec3 a = {1, -2, 3}, b = {3, 1, 4}, c = {-1, 2, 6}; // a skewed triangle

} // namespace

TEST_CASE("the point where a ray hits a triangle is the weighted mean of the vertices") {
    Random random(3);
    for (int i = 0; i < 1000; ++i) {
        vec2 uv = random.get_2d();
        if (uv.x + uv.y > 1) uv = 1.0f - uv;
        const vec3 target = (1 - uv.x - uv.y) * a + uv.x * b + uv.y * c;
        const Ray ray{target + 4.0f * random_direction(random), {}, 0, infinity};
        const Ray aimed{ray.origin, (target - ray.origin) / 2.5f};
        const auto hit = intersect(a, b, c, aimed);
        if (std::min({uv.x, uv.y, 1 - uv.x - uv.y}) < 1e-3f) continue; // too close to an edge to decide
        if (std::abs(dot(normalize(aimed.direction), normalize(cross(b - a, c - a)))) < 0.05f) continue;
        INFO("u, v = ", uv);
        REQUIRE_MESSAGE(hit, "the ray points into the triangle: s = O - A, and both sides count");
        CHECK_MESSAGE(hit->t == approx(2.5f, 1e-4f),
                      "1/det is missing, or t belongs to a normalised direction");
        CHECK_MESSAGE(vec2(hit->u, hit->v) == approx(uv, 1e-4f), "(v, u): the weights are swapped");
    }
}

TEST_CASE("a ray beside a triangle misses it even in the other half of its parallelogram") {
    const vec3 from{4, -3, 9};
    const auto hits_at = [&](std::initializer_list<vec2> beside) {
        std::string hits;
        for (const vec2 uv : beside) {
            const vec3 target = (1 - uv.x - uv.y) * a + uv.x * b + uv.y * c;
            if (intersect(a, b, c, Ray{from, target - from})) hits += to_text(uv);
        }
        return hits;
    };
    const std::string over_the_sum = hits_at({{0.7f, 0.7f}, {1.01f, 0}, {0.505f, 0.505f}, {2, 2}});
    CHECK_MESSAGE(over_the_sum == "", "u + v > 1 must be tested, not only u and v");
    const std::string below_u = hits_at({{-0.01f, 0.5f}, {-0.2f, 1.1f}});
    CHECK_MESSAGE(below_u == "", "u < 0 must be tested, not only v and the sum");
    const std::string below_v = hits_at({{0.5f, -0.01f}, {1.3f, -0.2f}});
    CHECK_MESSAGE(below_v == "", "v < 0 must be tested, not only u and the sum");
}

TEST_CASE("a triangle is hit from both sides") {
    const vec3 target = (a + b + c) / 3.0f, n = normalize(cross(b - a, c - a));
    for (const float side : {1.0f, -1.0f}) {
        const auto hit = intersect(a, b, c, Ray{target + side * 3.0f * n, -side * 2.0f * n});
        REQUIRE_MESSAGE(hit, "back faces must be hit too: glass needs them");
        CHECK(hit->t == approx(1.5f));
    }
}

TEST_CASE("a triangle behind the ray or outside its interval is not hit") {
    const vec3 target = (a + b + c) / 3.0f, away{0.3f, -0.5f, 0.4f};
    CHECK_MESSAGE(!intersect(a, b, c, Ray{target + away, away}), "t = -1: the triangle is behind the ray");
    const vec3 beside_v = a + 0.5f * (b - a) - 0.3f * (c - a),
               beside_both = a - 0.3f * (b - a) - 0.3f * (c - a);
    CHECK_MESSAGE(!intersect(a, b, c, Ray{beside_v + away, away}), "v and t have the wrong sign");
    CHECK_MESSAGE(!intersect(a, b, c, Ray{beside_both + away, away}), "u, v and t have the wrong sign");
    CHECK(intersect(a, b, c, Ray{target + away, -away}).has_value());
    CHECK_MESSAGE(!intersect(a, b, c, Ray{target + away, -away, 0, 0.99f}), "t = 1 is beyond t_max = .99");
    CHECK_MESSAGE(!intersect(a, b, c, Ray{target + away, -away, 1.01f, 5}), "t = 1 is before t_min = 1.01");
    int hits = 0; // of rays that begin at eleven places on a line, at t = -4.5, -3.5, ..., 5.5
    for (int i = -5; i <= 5; ++i)
        hits += intersect(a, b, c, Ray{target + (float(i) + 0.5f) * away, -away, 0, 2}).has_value();
    CHECK_MESSAGE(hits == 2, "only t = .5 and 1.5 are between 0 and 2");
}

TEST_CASE("a triangle is hit at any size") {
    for (const float size : {1e-8f, 1e-3f, 1.0f, 1e4f, 1e8f}) {
        INFO("size ", size);
        const vec3 target = (0.2f * a + 0.3f * b + 0.5f * c) * size, from = vec3(4, -3, 9) * size;
        const auto hit = intersect(size * a, size * b, size * c, Ray{from, target - from});
        REQUIRE_MESSAGE(hit, "a small determinant only means a small triangle");
        CHECK(hit->t == approx(1, 1e-4f));
        CHECK(vec2(hit->u, hit->v) == approx({0.3f, 0.5f}, 1e-4f));
    }
}

TEST_CASE("a ray in the plane of a triangle misses it and so does every ray a triangle without area") {
    CHECK(!intersect({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, Ray{{-1, 0.2f, 0}, {1, 0, 0}}));
    CHECK(!intersect({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, Ray{{-1, 0.2f, 0.1f}, {1, 0, 0}}));
    CHECK(!intersect(a, a, a, Ray{{4, -3, 9}, a - vec3(4, -3, 9)}));
    CHECK(!intersect({0, 0, 0}, {1, 2, 1}, {2, 4, 2}, Ray{{0, 0, 5}, {0.2f, 0.4f, -1}}));
    CHECK(!intersect({0, 0, 0}, {1, 0, 0}, {1, 0, 0}, Ray{{0.5f, 3, 0}, {0, -1, 0}}));
}

TEST_CASE("no ray slips through the edge that two triangles share") {
    Random random(11);
    int slipped = 0;
    std::string first;
    for (int i = 0; i < 200000; ++i) {
        const vec3 p = 4.0f * random_point(random), q = 4.0f * random_point(random),
                   r = 4.0f * random_point(random);
        const vec3 far = p + q - r + (random_point(random) - 0.5f); // on the other side of p q
        const vec3 target = mix(p, q, 0.02f + 0.96f * random.get_1d());
        const vec3 from = target + 5.0f * random_direction(random);
        const vec3 n1 = normalize(cross(q - p, r - p)), n2 = normalize(cross(p - q, far - q));
        const vec3 d = normalize(target - from);
        if (dot(n1, d) * dot(n2, d) < 0 || std::min(std::abs(dot(n1, d)), std::abs(dot(n2, d))) < 0.05f)
            continue; // seen from here, both are on the same side of the edge
        const Ray ray{from, target - from};
        if (intersect(p, q, r, ray) || intersect(q, p, far, ray)) continue;
        if (slipped++ == 0)
            first =
                to_text(from) + " to " + to_text(target) + " on the edge " + to_text(p) + " " + to_text(q);
    }
    CHECK_MESSAGE(slipped == 0, slipped, " slipped through, the first from ", first);
}
