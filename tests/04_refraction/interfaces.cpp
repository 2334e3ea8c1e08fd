// Facts about rays through boundaries: which medium is where, and how balls, bubbles and slabs refract a ray.
// A ray that enters a ball from outside always gets out again, so total reflection is tested
// with air bubbles in glass.
#include "tests/04_refraction/scenes.h"

using namespace rt;

namespace {

float angle_between(vec3 a, vec3 b) {
    return glm::degrees(std::atan2(length(cross(a, b)), dot(a, b)));
}

} // namespace

TEST_CASE("an air bubble reflects all light that passes more than R / n from its centre") {
    const Glassware scene = ball_of(bubble);
    for (float offset = 0; offset < 1; offset += 0.02f) {
        if (std::abs(offset - 1 / 1.5f) < 0.001f) continue;
        INFO("offset ", offset, " radii, total reflection begins at .6667");
        const Ray ray = ray_beside(offset);
        const auto hit = intersect(scene, ray);
        REQUIRE(hit);
        const Interface interface = make_interface(bubble, ray, *hit);
        const bool total = offset > 1 / 1.5f;
        CHECK((interface.reflectance == 1) == total);
        CHECK_MESSAGE(refracted_ray(ray, *hit, interface).has_value() == !total,
                      "a bubble is {inside: air, outside: glass}: the ray comes from the glass");
    }
}

TEST_CASE("the side of a boundary from which a ray comes determines its medium") {
    const Medium oil{1.47f, {1, 2, 3}}, water{1.333f, {0.3f, 0.2f, 0.1f}};
    const Dielectric drop{oil, water};
    const Glassware scene = ball_of(drop);
    const Ray ray = ray_beside(0.5f);
    const auto hit = intersect(scene, ray);
    REQUIRE(hit);
    const Interface in = make_interface(drop, ray, *hit);
    CHECK_MESSAGE(in.incident_medium.ior == water.ior, "the ray comes from outside");
    CHECK(in.transmitted_medium.ior == oil.ior);
    CHECK(in.incident_medium.absorption_coefficient == water.absorption_coefficient);
    CHECK(in.transmitted_medium.absorption_coefficient == oil.absorption_coefficient);
    CHECK_MESSAGE(in.reflectance == approx(fresnel_dielectric(std::sqrt(0.75f), 1.333f / 1.47f)),
                  "at offset R / 2 the angle is 30 degrees; the direction has length 2 here, so normalise it "
                  "for the cosine");

    const Ray out_ray{center, -2.0f * tangent};
    const auto out_hit = intersect(scene, out_ray);
    REQUIRE(out_hit);
    const Interface out = make_interface(drop, out_ray, *out_hit);
    CHECK_MESSAGE(out.incident_medium.ior == oil.ior, "the ray comes from inside: not every ray enters");
    CHECK(out.transmitted_medium.ior == water.ior);
    CHECK(out.transmitted_medium.absorption_coefficient == water.absorption_coefficient);
    CHECK(out.reflectance == approx(fresnel_dielectric(1, 1.47f / 1.333f)));
}

TEST_CASE("a refracted ray starts just beyond the boundary") {
    const Glassware scene = ball_of(ball);
    for (float offset = 0; offset < 0.96f; offset += 0.05f) {
        INFO("offset ", offset);
        const auto inside = passed(scene, ray_beside(offset));
        REQUIRE(inside);
        CHECK_MESSAGE(distance(inside->origin, center) < radius,
                      "the ray starts outside and hits the same boundary again");
        CHECK(distance(inside->origin, center) == approx(radius, 1e-4f));
        const auto outside = passed(scene, *inside);
        REQUIRE(outside);
        CHECK_MESSAGE(distance(outside->origin, center) > radius,
                      "the ray starts inside and hits the same boundary again");
        CHECK_MESSAGE(!intersect(scene, *outside), "the ray is outside and must not hit the ball again");
    }
}

TEST_CASE("a ray half a radius off the centre of a glass ball is deflected by 21.0576 degrees") {
    const Glassware scene = ball_of(ball);
    const auto inside = passed(scene, ray_beside(0.5f));
    REQUIRE(inside);
    const auto outside = passed(scene, *inside);
    REQUIRE_MESSAGE(outside,
                    "every ray that enters gets out: on the way out, swap the indices and flip the normal");
    CHECK_MESSAGE(angle_between(outside->direction, -normal) == approx(21.0576f, 1e-4f),
                  "10.53: refracted only once; 0: not at all");
    CHECK_MESSAGE(dot(outside->direction, tangent) < 0, "a glass ball refracts light towards its axis");
    CHECK(length(outside->direction) == approx(2));
}

TEST_CASE("a ray half a radius off the centre of an air bubble in glass is deflected away from its axis") {
    // Inward, asin(.5) = 30 becomes asin(.75) = 48.5904 degrees; the total is twice the difference.
    const Glassware scene = ball_of(bubble);
    const auto inside = passed(scene, ray_beside(0.5f));
    REQUIRE(inside);
    const auto outside = passed(scene, *inside);
    REQUIRE(outside);
    CHECK(angle_between(outside->direction, -normal) == approx(37.1808f, 1e-4f));
    CHECK_MESSAGE(dot(outside->direction, tangent) > 0, "a bubble makes light diverge");
}

TEST_CASE("a glass ball focuses rays near its axis 1.5 radii from its centre") {
    const Glassware scene = ball_of(ball);
    for (const float offset : {0.02f, 0.01f, -0.01f}) {
        const auto inside = passed(scene, ray_beside(offset));
        REQUIRE(inside);
        const auto outside = passed(scene, *inside);
        REQUIRE(outside);
        const vec3 from_center = outside->origin - center;
        const float t = -dot(from_center, tangent) / dot(outside->direction, tangent);
        CHECK_MESSAGE(dot(from_center + t * outside->direction, -normal) == approx(1.5f * radius, 1e-3f),
                      "focal length n R / (2 (n - 1)), measured from the centre");
    }
}

TEST_CASE("a ray that enters a glass ball from outside can always leave it") {
    for (const float ior : {1.01f, 1.5f, 2.417f, 4.0f}) {
        const Dielectric glass{{ior}};
        const Glassware scene = ball_of(glass);
        for (float offset = 0; offset < 0.995f; offset += 0.03f) {
            INFO("n = ", ior, ", offset ", offset);
            const Ray ray = ray_beside(offset);
            const auto inside = passed(scene, ray);
            REQUIRE(inside);
            const auto hit = intersect(scene, *inside);
            REQUIRE(hit);
            const Interface out = make_interface(glass, *inside, *hit);
            CHECK(out.reflectance ==
                  approx(make_interface(glass, ray, *intersect(scene, ray)).reflectance, 2e-3f));
            CHECK(refracted_ray(*inside, *hit, out).has_value());
        }
    }
}

TEST_CASE("a slab shifts a ray sideways and does not change its direction") {
    const Glassware scene = slab_of(glass_15, 0.7f);
    const vec3 direction = arriving(60);
    const auto inside = passed(scene, Ray{-direction, direction});
    REQUIRE(inside);
    const auto outside = passed(scene, *inside);
    REQUIRE(outside);
    CHECK(outside->direction == approx(direction));
    // The shift is depth times sin_i (1 - cos_i / (n cos_t)).
    const float sin_i = std::sin(glm::radians(60.0f)), cos_t = std::sqrt(1 - sin_i * sin_i / 2.25f);
    CHECK(length(cross(outside->origin, direction)) / 2 ==
          approx(0.7f * sin_i * (1 - 0.5f / (1.5f * cos_t)), 1e-4f));
}

TEST_CASE("a ray through a bubble in a ball passes air, glass, air, glass and air") {
    Glassware scene = ball_of(ball);
    scene.spheres.push_back({center, 0.6f * radius, add(scene.materials, bubble)});
    const float indices[] = {1, 1.5f, 1, 1.5f, 1};
    Ray ray = ray_beside(0.3f);
    for (int i = 0; i < 4; ++i) {
        INFO("boundary ", i + 1);
        const auto hit = intersect(scene, ray);
        REQUIRE(hit);
        const Interface interface =
            make_interface(std::get<Dielectric>(scene.materials[std::size_t(hit->material)]), ray, *hit);
        CHECK(interface.incident_medium.ior == indices[i]);
        CHECK(interface.transmitted_medium.ior == indices[i + 1]);
        const auto refracted = refracted_ray(ray, *hit, interface);
        REQUIRE(refracted);
        ray = *refracted;
        // Concentric spheres conserve n b: the index times the distance of the ray's line from the centre.
        const float b = length(cross(ray.origin - center, ray.direction)) / length(ray.direction);
        CHECK(indices[i + 1] * b == approx(0.3f * radius, 1e-4f));
    }
    CHECK_MESSAGE(!intersect(scene, ray), "after four boundaries the ray must be outside");
}
