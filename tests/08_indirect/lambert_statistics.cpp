// Facts about large triangles: the irradiance of a lamp on a floor follows Lambert's formula.
// It does so whether the floor measures a metre or a kilometre, for all acceleration
// structures and sampling strategies.
#include "08_indirect/radiance.h"
#include "08_indirect/scene.h"
#include "common/math/random.h"
#include "tests/05_mesh_bvh/rays.h"
#include "tests/08_indirect/lamps.h"
#include "tests/check.h"

#include <array>
#include <string>
#include <vector>

using namespace rt;

namespace {

/// A lamp over a floor of two triangles, not aligned with any axis, and a ray towards the floor.
struct Case {
    Scene scene;
    Ray ray;
    std::vector<vec3> lamp; ///< vertices
    vec3 position, normal;  ///< of the point that the ray hits
    float floor_size, eye_distance;
};

Case make_case(Random& random, int number) {
    const vec3 up = normalize(random_direction(random));
    const vec3 right = normalize(cross(up, random_direction(random))), forward = cross(right, up);
    const vec3 center = 4.0f * random_direction(random);
    const auto point = [&](float x, float height, float y) {
        return center + x * right + height * up + y * forward;
    };
    const auto spread = [&](float size) { return size * (2 * random.get_1d() - 1); };

    Case made;
    made.floor_size = std::array{1.0f, 10.0f, 100.0f, 1000.0f}[std::size_t(number % 4)];
    const float half = made.floor_size / 2;
    const int floor = add(made.scene.materials, Diffuse{vec3(1)}),
              lamp = add(made.scene.materials, emissive(vec3(1)));
    const std::array corner{point(-half, 0, -half), point(half, 0, -half), point(half, 0, half),
                            point(-half, 0, half)};
    add_triangle(made.scene, corner[0], corner[2], corner[1], floor);
    add_triangle(made.scene, corner[0], corner[3], corner[2], floor);
    made.normal = normalize(cross(corner[2] - corner[0], corner[1] - corner[0]));

    const float height = 0.3f + 3 * random.get_1d(), size = height * (0.6f + 0.6f * random.get_1d());
    const float x = spread(half / 4), y = spread(half / 4);
    made.position = point(x, 0, y);
    const vec3 middle = point(x + spread(height / 2), height, y + spread(height / 2));
    const vec3 edge_u = size * normalize(right + spread(1) * forward + spread(0.4f) * up);
    const vec3 edge_v = size * normalize(forward + spread(0.3f) * up);
    if (number % 2 == 0) {
        made.scene.quads = {{middle, edge_u, edge_v, lamp}};
        made.lamp = corners_of(made.scene.quads[0]);
    } else {
        made.lamp = {middle, middle + edge_u, middle + edge_v};
        add_triangle(made.scene, made.lamp[0], made.lamp[1], made.lamp[2], lamp);
    }
    made.eye_distance = std::array{0.01f, 0.1f, 1.0f}[std::size_t(number % 3)];
    const vec3 eye =
        made.position + made.eye_distance * normalize(up + spread(2) * right + spread(2) * forward);
    made.ray = {eye, normalize(made.position - eye)};
    return made;
}

Mean seen(Case& made, Accel accel, DirectLighting direct) {
    made.scene.accel = accel;
    build_bvhs(made.scene);
    const AreaLights lights = collect_area_lights(made.scene);
    Random random(11);
    Mean mean;
    for (int i = 0; i < 10000; ++i)
        mean.add(double(radiance(made.scene, lights, {.depth = 1, .direct = direct}, made.ray, random).x));
    return mean;
}

} // namespace

TEST_CASE("a lamp over a floor of any size causes the irradiance of Lambert's formula") {
    Random random(1760);
    for (int number = 0; number < 24; ++number) {
        Case made = make_case(random, number);
        const double expected = form_factor(made.lamp, made.position, made.normal);
        for (const Accel accel : {Accel::brute, Accel::bvh, Accel::wide})
            for (const DirectLighting direct :
                 {DirectLighting::mis, DirectLighting::light_sampling, DirectLighting::bsdf_sampling}) {
                const Mean mean = seen(made, accel, direct);
                INFO("case ", number, ", floor of ", made.floor_size, " m seen from ", made.eye_distance,
                     " m, accel ", int(accel), ", direct ", int(direct), ": ", mean.against(expected));
                CHECK_MESSAGE(
                    std::abs(mean.z(expected)) < 4,
                    "too dark: the floor or the lamp shadows itself; its t is off in proportion to its size");
            }
    }
}
