// Facts about the hit of a mesh: vertex weights, normals, uv and bounds; and about the placement of a model.
// Meshes of many triangles are in 05_mesh_bvh_mesh_in_scenes.cpp.
#include "05_mesh_bvh/mesh.h"
#include "common/math/random.h"
#include "tests/check.h"
#include "tests/meshes.h"

using namespace rt;

namespace {

const vec3 a = {1, -2, 3}, b = {3, 1, 4}, c = {-1, 2, 6}; // a skewed triangle

/// A mesh of few triangles whose hits are found by solving a linear system, so that these checks need neither
/// a tree nor triangle.h.
struct Scene {
    Mesh mesh;
};

Scene scene_of(const ObjModel& file) {
    Scene scene;
    append_model(scene.mesh, file, {0}, 40);
    return scene;
}

std::optional<Hit> intersect(const Scene& scene, Ray ray) {
    std::optional<MeshHit> nearest;
    for (std::uint32_t i = 0; i < scene.mesh.triangles.size(); ++i) {
        const auto [p, q, r] = vertices(scene.mesh, i);
        const glm::dmat3 columns(dvec3(q - p), dvec3(r - p), -dvec3(ray.direction));
        const dvec3 uvt = inverse(columns) * dvec3(ray.origin - p); // p + u (q - p) + v (r - p) = O + t D
        if (!(std::min({uvt.x, uvt.y, 1 - uvt.x - uvt.y}) >= -1e-9) || !contains(ray, float(uvt.z))) continue;
        ray.t_max = float(uvt.z);
        nearest = MeshHit{&scene.mesh, i, float(uvt.x), float(uvt.y)};
    }
    return nearest ? std::optional(surface_hit(*nearest, ray)) : std::nullopt;
}

} // namespace

TEST_CASE("the bounding box of a sphere and of a triangle touches it on all sides") {
    const Aabb sphere = bounds(Sphere{{1, -2, 3}, 2, 0});
    CHECK(sphere.min == vec3(-1, -4, 1));
    CHECK(sphere.max == vec3(3, 0, 5));
    ObjModel file = empty_file();
    add_triangle(file, a, b, c);
    add_triangle(file, c + 1.0f, a + 1.0f, b + 1.0f);
    const Scene scene = scene_of(file);
    CHECK_MESSAGE(bounds(scene.mesh, 0).min == vec3(-1, -2, 3), "all three vertices count");
    CHECK(bounds(scene.mesh, 0).max == vec3(3, 2, 6));
    CHECK(bounds(scene.mesh, 1).min == vec3(0, -1, 4));
    CHECK(bounds(scene.mesh).min == vec3(-1, -2, 3));
    CHECK(bounds(scene.mesh).max == vec3(4, 3, 7));
}

TEST_CASE("the geometric normal of a hit has unit length and is perpendicular to the triangle on the side of "
          "the ray") {
    ObjModel file = empty_file();
    add_triangle(file, a, b, c);
    file.normals = {vec3(1, -1, 3)};
    for (ObjIndex& corner : file.triangles[0]) corner.normal = 0;
    const Scene scene = scene_of(file);
    const vec3 n = normalize(cross(b - a, c - a));
    for (const float side : {1.0f, -1.0f}) {
        const auto hit = intersect(scene, Ray{(a + b + c) / 3.0f + side * 3.0f * n, -side * 2.0f * n});
        REQUIRE(hit);
        CHECK_MESSAGE(hit->geometric_normal == approx(side * n),
                      "the vertices run counter-clockwise seen from outside");
        CHECK_MESSAGE(hit->back_face == (side < 0), "the ray comes from behind, which is inside");
        CHECK_MESSAGE(
            hit->shading_normal == approx(side * normalize(vec3(1, -1, 3))),
            "the given normal, normalised, flipped to the side of the ray together with the geometric one");
        CHECK(hit->position == approx((a + b + c) / 3.0f));
    }
}

TEST_CASE("normals and uv are interpolated over a triangle with the barycentric weights") {
    ObjModel file = empty_file();
    add_triangle(file, {0, 0, 0}, {2, 0, 0}, {0, 3, 0});
    file.normals = {{0, 0, 5}, {0.6f, 0, 0.8f}, {0, 2, 2}};
    file.uvs = {{0.1f, 0.9f}, {0.7f, 0.2f}, {3, -2}};
    for (int k = 0; k < 3; ++k) {
        file.triangles[0][std::size_t(k)].normal = k;
        file.triangles[0][std::size_t(k)].uv = k;
    }
    const Scene scene = scene_of(file);
    const auto hit = intersect(scene, Ray{{0.4f, 1.5f, 4}, {0, 0, -2}}); // u = .2, v = .5
    REQUIRE(hit);
    CHECK_MESSAGE(hit->uv == approx(0.3f * vec2(0.1f, 0.9f) + 0.2f * vec2(0.7f, 0.2f) + 0.5f * vec2(3, -2)),
                  "(1 - u - v) A + u B + v C");
    const vec3 blend = 0.3f * vec3(0, 0, 1) + 0.2f * vec3(0.6f, 0, 0.8f) + 0.5f * normalize(vec3(0, 1, 1));
    CHECK_MESSAGE(hit->shading_normal == approx(normalize(blend)),
                  "normalise each, then interpolate, then normalise again");
    CHECK(hit->geometric_normal == approx({0, 0, 1}));
}

TEST_CASE("a triangle without uv coordinates has uv 0") {
    ObjModel file = empty_file();
    add_triangle(file, a, b, c);
    const auto hit = intersect(scene_of(file), Ray{(a + b + c) / 3.0f + vec3(0, 0, 3), {0, 0, -1}});
    REQUIRE(hit);
    CHECK(hit->uv == vec2(0));
}

TEST_CASE("a normal is bent no further than needed for a mirror to clear the surface") {
    Random random(63);
    int bent = 0;
    for (int i = 0; i < 20000; ++i) {
        const vec3 geometric = normalize(random_direction(random));
        vec3 direction = normalize(random_direction(random)), smooth = normalize(random_direction(random));
        if (dot(direction, geometric) > 0) direction = -direction;
        if (dot(smooth, geometric) < 0) smooth = -smooth;
        if (dot(smooth, geometric) < 0.05f || dot(direction, geometric) > -0.02f) continue;
        const vec3 cleared = ensure_valid_reflection(direction, smooth, geometric);
        const vec3 reflected = reflect(direction, cleared);
        if (!(length(cleared) == approx(1, 1e-4f) && dot(reflected, geometric) > 0))
            FAIL_CHECK("d ", direction, ", smooth ", smooth, ", true ", geometric, ": got ", cleared,
                       ", which reflects light into the surface");
        if (dot(reflect(direction, smooth), geometric) > 0.02f) {
            if (cleared != smooth) FAIL_CHECK("a valid normal must be returned unchanged");
        } else {
            ++bent;
        }
    }
    CHECK(bent > 100);
    const vec3 straight = normalize(vec3(1, 2, -2));
    CHECK(ensure_valid_reflection(-straight, straight, straight) == straight);
}

TEST_CASE("at a seam of the uv map each triangle keeps its own uv") {
    ObjModel file = empty_file();
    file.positions = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}};
    file.uvs = {{0.1f, 0.2f}, {0.9f, 0.3f}};
    file.triangles = {{{{0, 0}, {1, 0}, {2, 0}}}, {{{0, 1}, {2, 1}, {3, 1}}}};
    file.triangle_materials = {0, 0};
    const Scene scene = scene_of(file);
    CHECK(intersect(scene, Ray{{1.5f, 0.5f, 2}, {0, 0, -1}})->uv == approx({0.1f, 0.2f}));
    CHECK_MESSAGE(intersect(scene, Ray{{0.5f, 1.5f, 2}, {0, 0, -1}})->uv == approx({0.9f, 0.3f}),
                  "corners at one position are one vertex only if their uv are equal");
}

TEST_CASE("transform scales a model then rotates it from +z towards +x and then translates it") {
    ObjModel file = empty_file();
    add_triangle(file, {0, 0, 1}, {1, 0, 0}, {0, 3, 0});
    file.normals = {{0, 0, 1}};
    transform(file, 2, 90, {10, 20, 30});
    CHECK_MESSAGE(file.positions[0] == approx({12, 20, 30}), "after a quarter turn, +z becomes +x");
    CHECK(file.positions[1] == approx({10, 20, 28}));
    CHECK(file.positions[2] == approx({10, 26, 30}));
    CHECK_MESSAGE(file.normals[0] == approx({1, 0, 0}), "normals are rotated and not translated");
}
