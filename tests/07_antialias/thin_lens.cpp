// Facts about a thin lens: the origins of its rays, their convergence, and the circle of confusion.
// Statistical checks are z-tests with fixed seeds; a correct renderer exceeds |z| =
// 4 in one run out of 16,000.
#include "07_antialias/program/options.h"
#include "tests/check.h"

#include <array>
#include <cmath>
#include <vector>

using namespace rt;

namespace {

const LookAt look_at{.from = {1, 2, 3}, .at = {-1, 1.5f, -4}, .up = {0.1f, 1, 0}, .fov = 50};
const Camera camera = make_camera(look_at, 600, 400);

/// Returns the point where the ray crosses the plane at `depth` in front of the camera.
vec3 at_depth(const Ray& ray, float depth) {
    return at(ray,
              (depth - dot(ray.origin - camera.origin, camera.forward)) / dot(ray.direction, camera.forward));
}

/// Returns a grid over [0, 1)^2 that includes its corners, its edges and its centre.
std::vector<vec2> grid() {
    std::vector<vec2> points;
    for (int y = 0; y <= 32; ++y)
        for (int x = 0; x <= 32; ++x) points.push_back(min(vec2(x, y) / 32.0f, vec2(0x1.fffffep-1f)));
    return points;
}

} // namespace

TEST_CASE("points of the disk are spread evenly by area, and even points stay even") {
    // Even by area: the mean of r^2 is 1/2 and that of r^4 is 1/3; x and y have the same
    // distribution and are uncorrelated.
    Mean x, y, xy, difference, square, fourth;
    Random random(3);
    for (int i = 0; i < 100'000; ++i) {
        const vec2 p = sample_disk_concentric(random.get_2d());
        const double r2 = double(dot(p, p));
        REQUIRE(r2 <= 1 + 1e-6);
        x.add(double(p.x)), y.add(double(p.y)), xy.add(double(p.x * p.y));
        difference.add(double(p.x * p.x - p.y * p.y)), square.add(r2), fourth.add(r2 * r2);
    }
    INFO("mean of r^2; 1/3: the radius is uniform instead of the area; 2/3: the corners are not folded in: "
         << square.against(0.5));
    CHECK(std::abs(square.z(0.5)) < 4);
    INFO("mean of r^4: " << fourth.against(1.0 / 3));
    CHECK(std::abs(fourth.z(1.0 / 3)) < 4);
    INFO("means of x, y, x y, x^2 - y^2: " << x.against(0) << "; " << y.against(0) << "; " << xy.against(0)
                                           << "; " << difference.against(0));
    for (const Mean& mean : {x, y, xy, difference}) CHECK(std::abs(mean.z(0)) < 4);
    // Any mapping that preserves area is right, the polar one too: a small square of side h becomes a patch of
    // area pi h^2, whichever way round.
    for (const vec2 u :
         {vec2(0.2f, 0.3f), vec2(0.9f, 0.6f), vec2(0.55f, 0.95f), vec2(0.4f, 0.1f), vec2(0.05f, 0.5f)}) {
        const float h = 1 / 256.0f;
        const vec2 right = sample_disk_concentric(u + vec2(h, 0)) - sample_disk_concentric(u - vec2(h, 0));
        const vec2 up = sample_disk_concentric(u + vec2(0, h)) - sample_disk_concentric(u - vec2(0, h));
        INFO("around " << to_text(u));
        CHECK(std::abs(right.x * up.y - right.y * up.x) / (4 * h * h) == approx(pi, 2e-3f));
    }
    CHECK_MESSAGE(length(sample_disk_concentric(vec2(0.5f))) <= 1, "NaN: 0 / 0 at the centre of the square");
}

TEST_CASE("a lens of zero width is a pinhole to the last bit") {
    for (const vec2 pixel : {vec2(0), vec2(300, 200), vec2(17.3f, 391.8f)})
        for (const vec2 u : grid()) {
            const Ray ray = thin_lens_ray(camera, {0, 3}, pixel, u), pinhole = camera_ray(camera, pixel);
            CHECK(ray.origin == pinhole.origin);
            CHECK(ray.direction == pinhole.direction);
        }
    Sampler asked(SamplerKind::sobol, PixelSample{1, 2, 3, 16, Random(1, 2, 3, 4), 4}), untouched = asked;
    CHECK(sample_camera_ray(camera, {0, 3}, vec2(9), asked).direction ==
          camera_ray(camera, vec2(9)).direction);
    CHECK_MESSAGE(asked.get_1d() == untouched.get_1d(), "a pinhole must not draw numbers");
}

TEST_CASE("rays start all over the lens perpendicular to the line of sight") {
    const ThinLens lens{0.8f, 3};
    float farthest = 0;
    for (const vec2 u : grid()) {
        const Ray ray = thin_lens_ray(camera, lens, {17.3f, 391.8f}, u);
        CHECK(dot(ray.origin - camera.origin, camera.forward) == approx(0, 1e-6f));
        CHECK(length(ray.direction) == approx(1));
        farthest = std::max(farthest, distance(ray.origin, camera.origin));
    }
    INFO("the aperture is the diameter of the lens: rays start up to half of it from its centre");
    CHECK(farthest == approx(0.4f, 1e-4f));
    // The lens is round: equally wide along both axes of the picture, whatever its aspect ratio.
    Mean across, along;
    Random random(5);
    for (int i = 0; i < 40'000; ++i) {
        const vec3 p = thin_lens_ray(camera, lens, {300, 10}, random.get_2d()).origin - camera.origin;
        const double x = double(dot(p, normalize(camera.half_width))),
                     y = double(dot(p, normalize(camera.half_height)));
        across.add(x * x), along.add(y * y);
    }
    INFO("mean squares, a quarter of the squared radius: " << across.against(0.04) << "; "
                                                           << along.against(0.04));
    CHECK(std::abs(across.z(0.04)) < 4);
    CHECK(std::abs(along.z(0.04)) < 4);
}

TEST_CASE("a point in the plane of focus is seen at one point of the picture from all over the lens") {
    for (const vec2 pixel : {vec2(0), vec2(300, 200), vec2(590, 30)}) {
        const vec3 seen = at_depth(camera_ray(camera, pixel), 5);
        for (const vec2 u : grid()) {
            INFO("through " << to_text(pixel)
                            << "; wrong only away from the centre: a sphere is in focus instead of a plane");
            CHECK(at_depth(thin_lens_ray(camera, {0.8f, 5}, pixel, u), 5) == approx(seen, 2e-6f));
        }
    }
}

TEST_CASE("a point that is out of focus becomes a disk as wide as a thin lens makes it") {
    // On the plane of focus, the circle of confusion has the diameter A |d - f| / d (Potmesil and Chakravarty
    // 1982). A ray from the lens through the point at depth d crosses that plane there; the point of the
    // picture that sees it is where the pinhole's ray crosses the plane too.
    const float aperture = 0.6f, focus = 4;
    for (const float depth : {1.5f, 3.0f, 4.0f, 7.0f, 60.0f}) {
        const float want = aperture * std::abs(depth - focus) / depth;
        float widest = 0;
        const vec2 pixel(210, 160);
        const vec3 middle = at_depth(camera_ray(camera, pixel), focus);
        // All rays of the pixel fill a disk of A |d - f| / f at the depth d: by similar triangles, a point
        // there fills one of that times f / d in the picture.
        const vec3 through = at_depth(camera_ray(camera, pixel), depth);
        for (const vec2 u : grid()) {
            const Ray ray = thin_lens_ray(camera, {aperture, focus}, pixel, u);
            widest = std::max(widest, 2 * distance(at_depth(ray, depth), through) * focus / depth);
        }
        INFO("at " << depth << " m");
        CHECK(widest == approx(want, 2e-3f));
        // Directly through the lens: the points of the picture from which a ray hits the point exactly.
        float reach = 0;
        for (const vec2 u : grid()) {
            const vec3 on_lens = thin_lens_ray(camera, {aperture, focus}, pixel, u).origin;
            const vec3 on_plane = on_lens + (through - on_lens) * (focus / depth);
            reach = std::max(reach, 2 * distance(on_plane, middle));
        }
        CHECK(reach == approx(want, 2e-3f));
    }
}

TEST_CASE("without --focus the camera focuses on the point that it looks at") {
    Options options("test", "Where is it sharp?", RenderSettings{});
    const LensOptions knobs(options);
    const std::array words{"test", "--aperture", "0.25"};
    REQUIRE(options.parse(int(words.size()), words.data()));
    CHECK(knobs.lens(look_at).aperture_diameter == 0.25f);
    CHECK(knobs.lens(look_at).focus_distance == approx(distance(look_at.from, look_at.at)));
    Options other("test", "Where is it sharp?", RenderSettings{});
    const LensOptions near(other);
    const std::array more{"test", "--aperture", "0.25", "--focus", "2.5"};
    REQUIRE(other.parse(int(more.size()), more.data()));
    CHECK(near.lens(look_at).focus_distance == 2.5f);
}
