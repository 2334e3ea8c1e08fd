// Facts about refraction, total reflection, the Fresnel equations and Beer-Lambert absorption.
#include "04_refraction/dielectric.h"
#include "tests/04_refraction/step.h"

using namespace rt;

namespace {

/// Returns the angle between -normal and a direction that points below the surface, degrees.
float angle_below(vec3 direction) {
    return glm::degrees(std::atan2(dot(direction, tangent), -dot(direction, normal)));
}

} // namespace

// ----------------------------------------------------------------------------------------- Snell's law

TEST_CASE("light that hits glass at 45 degrees continues at 28.1255 degrees") {
    const auto direction = refract(arriving(45), normal, 1 / 1.5f);
    REQUIRE_MESSAGE(direction, "air to glass: light always enters");
    CHECK_MESSAGE(angle_below(*direction) == approx(28.1255f),
                  "45: not refracted at all; none or 90: eta is inverted, it must be n_i / n_t; -28: the "
                  "tangential part must keep its sign; above 90: the normal part must keep its sign");
}

TEST_CASE("light that leaves glass at 28.1255 degrees continues at 45 degrees") {
    const auto direction = refract(arriving(28.1255f), normal, 1.5f);
    REQUIRE(direction);
    CHECK_MESSAGE(angle_below(*direction) == approx(45), "18.3: eta is inverted");
}

TEST_CASE("n sin(theta) is the same on both sides of a boundary, and no ray leaves the plane of incidence") {
    for (const float eta : {1 / 2.417f, 1 / 1.5f, 1 / 1.333f, 0.9f, 1.0f, 1.1f, 1.333f, 1.5f, 2.417f}) {
        for (float degrees = 0; degrees < 89.5f; degrees += 3.7f) {
            const float sin_t = eta * std::sin(glm::radians(degrees));
            if (sin_t > 0.9999f) continue; // total reflection, which other checks cover
            INFO("eta = n_i / n_t = ", eta, ", angle of incidence ", degrees);
            const auto direction = refract(arriving(degrees), normal, eta);
            REQUIRE(direction);
            CHECK(dot(*direction, tangent) / 2 == approx(sin_t));
            CHECK_MESSAGE(length(*direction) == approx(2), "the direction must keep its length, 2 here");
            CHECK(dot(*direction, binormal) == approx(0));
            CHECK_MESSAGE(dot(*direction, normal) < 0, "the ray must continue on the far side");
        }
    }
}

TEST_CASE("cos_transmitted returns the cosine of the angle beyond the boundary") {
    const auto into = cos_transmitted(cosine(45), 1 / 1.5f);
    REQUIRE(into);
    CHECK_MESSAGE(*into == approx(cosine(28.1255f)), ".7778: this is its square; .4714: this is the sine");
    const auto out = cos_transmitted(cosine(28.1255f), 1.5f);
    REQUIRE(out);
    CHECK(*out == approx(cosine(45)));
}

TEST_CASE("a reversed ray takes the same path through the boundary") {
    for (float degrees = 0; degrees < 89; degrees += 4.3f) {
        INFO("angle of incidence ", degrees);
        const vec3 there = arriving(degrees);
        const auto inside = refract(there, normal, 1 / 1.5f);
        REQUIRE(inside);
        const auto back = refract(-*inside, -normal, 1.5f);
        REQUIRE(back);
        CHECK(*back == approx(-there, 1e-4f));
    }
}

TEST_CASE("light that hits a boundary head-on continues straight, whatever the media") {
    for (const float eta : {1 / 2.417f, 1 / 1.5f, 1.0f, 1.5f, 2.417f}) {
        const auto direction = refract(-3.0f * normal, normal, eta);
        REQUIRE(direction);
        CHECK(*direction == approx(-3.0f * normal));
    }
}

TEST_CASE("between two equal media light continues straight and nothing is reflected") {
    for (float degrees = 0; degrees < 89; degrees += 5) {
        INFO("angle of incidence ", degrees);
        const auto direction = refract(arriving(degrees), normal, 1);
        REQUIRE(direction);
        CHECK(*direction == approx(arriving(degrees), 1e-4f));
        CHECK(fresnel_dielectric(cosine(degrees), 1) == approx(0));
    }
}

TEST_CASE("between two equal media even grazing light passes") {
    for (const float cos_i : {1e-2f, 1e-4f, 1e-6f}) {
        INFO("cosine of incidence ", cos_i,
             ": 1 - cos^2 rounds to 1, so solve for cos^2 of the refracted ray");
        const auto cos_t = cos_transmitted(cos_i, 1);
        REQUIRE(cos_t);
        CHECK(*cos_t / cos_i == approx(1, 1e-4f)); // 1 - cos^2 in double is off by 5e-5
        CHECK(fresnel_dielectric(cos_i, 1) == approx(0));
    }
}

TEST_CASE("a ray that just grazes glass stays finite and continues along the surface") {
    for (const float eta : {1 / 4.0f, 1 / 1.5f, 1.0f, 1.5f, 4.0f}) {
        for (const float degrees : {89.9f, 89.99f, 89.999f, 90.0f}) {
            INFO("eta ", eta, " at ", degrees, " degrees");
            const auto direction = refract(arriving(degrees), normal, eta);
            if (!direction) continue;
            CHECK(std::isfinite(dot(*direction, *direction)));
            CHECK(length(*direction) == approx(2, 1e-4f));
            CHECK(dot(*direction, normal) <= 1e-4f);
        }
    }
}

// --------------------------------------------------------------------------- total internal reflection

TEST_CASE("total reflection begins at 41.8103 degrees in glass, 48.6066 in water and 24.4397 in diamond") {
    struct Known {
        float ior, degrees;
    };
    for (const Known& known : {Known{1.5f, 41.8103f}, {1.333f, 48.6066f}, {2.417f, 24.4397f}}) {
        const float ior = known.ior, critical = known.degrees;
        float passes = 0, reflects = 90; // bisection finds the boundary between them
        for (int i = 0; i < 30; ++i) {
            const float middle = (passes + reflects) / 2;
            (cos_transmitted(cosine(middle), ior) ? passes : reflects) = middle;
        }
        INFO("from n = ", ior, " into air");
        CHECK_MESSAGE(passes == approx(critical, 1e-5f),
                      "90: there is no total reflection at all; 0: eta is inverted");
        CHECK(refract(arriving(critical - 0.01f), normal, ior).has_value());
        CHECK_MESSAGE(!refract(arriving(critical + 0.01f), normal, ior),
                      "beyond the critical angle there is no refracted ray: clamping the root to 0 or taking "
                      "its absolute value invents one");
        CHECK(fresnel_dielectric(cosine(critical - 0.01f), ior) < 1);
        CHECK_MESSAGE(fresnel_dielectric(cosine(critical + 0.01f), ior) == 1,
                      "all of the light must be reflected");
    }
}

TEST_CASE("light that enters the denser medium is never totally reflected") {
    for (const float ior : {1.0003f, 1.333f, 1.5f, 2.417f, 4.0f}) {
        for (float degrees = 0; degrees < 90; degrees += 1.3f) {
            INFO("into n = ", ior, " at ", degrees, " degrees");
            CHECK(cos_transmitted(cosine(degrees), 1 / ior).has_value());
            CHECK(refract(arriving(degrees), normal, 1 / ior).has_value());
        }
    }
}

// --------------------------------------------------------------------------------------------- Fresnel

TEST_CASE("head-on, glass reflects .04, water .020373 and diamond .171969, from either side") {
    struct Known {
        float ior, reflectance;
    };
    for (const Known& known : {Known{1.5f, 0.04f}, {1.333f, 0.020373f}, {2.417f, 0.171969f}}) {
        const float ior = known.ior, reflectance = known.reflectance;
        INFO("n = ", ior);
        const std::string hint =
            ".2 for glass: r0 must be squared; 0: Fresnel is missing; 1 - expected: R and T are swapped";
        CHECK_MESSAGE(fresnel_dielectric(1, 1 / ior) == approx(reflectance, 1e-6f), hint);
        CHECK_MESSAGE(fresnel_dielectric(1, ior) == approx(reflectance, 1e-6f), hint);
    }
}

TEST_CASE("from air, glass reflects what Fresnel's equations state at each angle") {
    struct Known {
        float degrees, reflectance;
    };
    for (const Known& known : {Known{30, 0.0415226f},
                               {45, 0.0502399f},
                               {60, 0.0891867f},
                               {75, 0.2530606f},
                               {80, 0.3877044f},
                               {85, 0.6127996f}}) {
        const float degrees = known.degrees, reflectance = known.reflectance;
        INFO("at ", degrees, " degrees");
        CHECK_MESSAGE(
            fresnel_dielectric(cosine(degrees), 1 / 1.5f) == approx(reflectance, 1e-6f),
            ".04 everywhere: independent of the angle; .0700 at 60: this is Schlick's approximation; 1 at "
            "45: eta is inverted; .0018 or .1766 at 60: only one polarisation, take the mean of both");
    }
}

TEST_CASE("from inside, glass reflects what Fresnel's equations state at each angle") {
    struct Known {
        float degrees, reflectance;
    };
    for (const Known& known :
         {Known{20, 0.041729f}, {30, 0.055190f}, {40, 0.245291f}, {41, 0.379751f}, {60, 1.0f}}) {
        const float degrees = known.degrees, reflectance = known.reflectance;
        INFO("at ", degrees, " degrees");
        CHECK_MESSAGE(fresnel_dielectric(cosine(degrees), 1.5f) == approx(reflectance, 5e-6f),
                      "less from 30 degrees on: the cosine of the wrong side, or eta is inverted");
    }
}

TEST_CASE("at Brewster's angle one polarisation vanishes, and the two rays are perpendicular") {
    const float brewster = glm::degrees(std::atan(1.5f));
    CHECK(brewster == approx(56.3099f));
    CHECK_MESSAGE(
        fresnel_dielectric(cosine(brewster), 1 / 1.5f) == approx(0.0739645f, 1e-6f),
        ".147929: this is the sum of both polarisations (.147929 and 0), or only the one: take the mean");
    const auto refracted = refract(arriving(brewster), normal, 1 / 1.5f);
    REQUIRE(refracted);
    CHECK(dot(*refracted, reflect(arriving(brewster), normal)) == approx(0));
}

TEST_CASE("a boundary reflects the same share of light along the same path in both directions") {
    for (const float ior : {1.0003f, 1.333f, 1.5f, 2.417f, 4.0f}) {
        for (float degrees = 0; degrees <= 89; degrees += 1.7f) {
            INFO("n = ", ior, ", outer angle ", degrees);
            const auto cos_t = cos_transmitted(cosine(degrees), 1 / ior);
            REQUIRE(cos_t);
            CHECK_MESSAGE(fresnel_dielectric(cosine(degrees), 1 / ior) ==
                              approx(fresnel_dielectric(*cos_t, ior), 1e-4f),
                          "F(theta_i, 1 -> n) = F(theta_t, n -> 1)");
        }
    }
}

TEST_CASE("a boundary reflects between 0 and 1 of the light, and all of it at grazing incidence") {
    for (float ior = 1; ior <= 4; ior += 0.0625f) {
        for (const float eta : {ior, 1 / ior}) {
            for (int i = 0; i <= 1000; ++i) {
                const float share = fresnel_dielectric(float(i) / 1000, eta);
                if (!(share >= 0 && share <= 1))
                    FAIL_CHECK("fresnel_dielectric(", float(i) / 1000, ", ", eta, ") = ", share);
            }
            if (ior > 1) CHECK(fresnel_dielectric(0, eta) == approx(1));
            if (ior >= 1.0625f) CHECK(fresnel_dielectric(1e-4f, eta) == approx(1, 5e-3f));
        }
    }
}

// ---------------------------------------------------------------------------------------- Beer-Lambert

TEST_CASE("the transmittance of a medium is exp(-absorption distance) in each channel") {
    CHECK_MESSAGE(transmittance({0.5f, 1.2f, 3}, 0.7f) == approx(vec3(0.704688f, 0.431711f, 0.122456f)),
                  "above 1: the minus sign is missing; 1 - a d: this is only the first-order term");
    CHECK(transmittance({0.5f, 1.2f, 3}, 0) == approx(vec3(1)));
    CHECK(transmittance(vec3(0), 1000) == approx(vec3(1)));
    CHECK_MESSAGE(transmittance({0.5f, 1.2f, 3}, 2) * transmittance({0.5f, 1.2f, 3}, 3) ==
                      approx(transmittance({0.5f, 1.2f, 3}, 5), 1e-7f),
                  "the transmittances of consecutive paths multiply");
}
