// Facts about computed vertex normals: they match their definition, and are computed in time.
#include "05_mesh_bvh/mesh.h"
#include "common/math/random.h"
#include "tests/check.h"
#include "tests/meshes.h"

#include <ctime>

using namespace rt;

namespace {

vec3 position_of(const ObjModel& file, const ObjIndex& corner) {
    return file.positions[std::size_t(corner.position)];
}

dvec3 area_of(const ObjModel& file, const std::array<ObjIndex, 3>& t) {
    return area_normal({position_of(file, t[0]), position_of(file, t[1]), position_of(file, t[2])});
}

/// Computes the definition of smooth_normals() directly.
vec3 asked_normal(const ObjModel& file, std::size_t triangle, std::size_t corner, float crease) {
    const vec3 here = position_of(file, file.triangles[triangle][corner]);
    const dvec3 own = area_of(file, file.triangles[triangle]);
    dvec3 sum(0);
    for (const auto& t : file.triangles) {
        const dvec3 other = area_of(file, t);
        const bool near =
            dot(own, other) >= double(std::cos(glm::radians(crease))) * length(own) * length(other);
        for (const ObjIndex& c : t)
            if (near && position_of(file, c) == here) sum += other;
    }
    return vec3(normalize(length(sum) > 0 ? sum : own));
}

} // namespace

TEST_CASE("large faces affect a smoothed normal more than small ones") {
    ObjModel file = empty_file();
    add_triangle(file, {0, 0, 0}, {0, -1, 0}, {3, 0, 0});       // area 1.5, faces up
    add_triangle(file, {0, 0, 0}, {0, 0.5f, 0.5f}, {-1, 0, 0}); // area .3536, oblique
    const auto normals = smooth_normals(file, 180);
    const vec3 sum = cross(vec3(0, -1, 0), vec3(3, 0, 0)) + cross(vec3(0, 0.5f, 0.5f), vec3(-1, 0, 0));
    CHECK_MESSAGE(normals[0][0] == approx(normalize(sum)), "points with equal coordinates are one point");
    CHECK(normals[1][0] == approx(normalize(sum)));
    CHECK_MESSAGE(normals[0][1] == approx({0, 0, 1}), "this vertex belongs to only one face");
}

TEST_CASE("a smoothed normal equals its definition to the last bit") {
    Random random(63);
    for (int round = 0; round < 300; ++round) {
        // Points of a small grid, so that many coincide, are coplanar or fold back on themselves; zeros of
        // both signs; some points are displaced.
        ObjModel file = empty_file();
        const float moved = round % 2 == 0 ? 0 : 0.3f;
        const auto point = [&] {
            const vec3 p = glm::floor(3.0f * random_point(random)) - 1.0f;
            if (random.get_1d() < 0.5f) return -p; // including -0, which equals 0
            return p + moved * random_point(random);
        };
        for (int i = 0; i < 60; ++i) {
            const vec3 p = point(), q = point(), r = point();
            if (length(area_normal({p, q, r})) > 0) add_triangle(file, p, q, r);
        }
        for (int i = 0; i < 30; ++i) file.positions[std::size_t(i)] = file.positions[std::size_t(3 * i)];
        std::erase_if(file.triangles, [&](const auto& t) { return !(length(area_of(file, t)) > 0); });
        const float crease = std::array{0.0f, 10.0f, 40.0f, 90.0f, 180.0f}[std::size_t(round % 5)];
        const auto normals = smooth_normals(file, crease);
        for (std::size_t i = 0; i < normals.size(); ++i)
            for (std::size_t k = 0; k < 3; ++k)
                if (!(normals[i][k] == asked_normal(file, i, k, crease)))
                    FAIL_CHECK("crease ", crease, ": ", normals[i][k], ", by definition ",
                               asked_normal(file, i, k, crease));
    }
}

TEST_CASE("a hundred thousand faces may share one vertex") {
    // A flat cone, once without normals and once with one normal per face at its tip.
    ObjModel file = empty_file();
    const int count = 100000;
    file.positions = {{0, 0.2f, 0}};
    for (int i = 0; i < count; ++i) {
        const float angle = 2 * pi * float(i) / count;
        file.positions.push_back({std::cos(angle), 0, -std::sin(angle)});
        file.normals.push_back({0.2f * std::cos(angle), 1, -0.2f * std::sin(angle)});
        file.triangles.push_back({{{0}, {1 + i}, {1 + (i + 1) % count}}});
        file.triangle_materials.push_back(0);
    }
    const auto seconds = [&] {
        const std::clock_t start = std::clock();
        Mesh mesh;
        append_model(mesh, file, {0}, 40);
        CHECK(mesh.triangles.size() == std::size_t(count));
        return double(std::clock() - start) / CLOCKS_PER_SEC;
    };
    const char* const usual = " s; hundredths are usual; many seconds: each face visits every other one";
    const double made = seconds();
    CHECK_MESSAGE(made < 4, made, usual);
    for (std::size_t i = 0; i < file.triangles.size(); ++i)
        for (ObjIndex& corner : file.triangles[i]) corner.normal = int(i);
    const double given = seconds();
    CHECK_MESSAGE(given < 4, given, usual);
}

TEST_CASE("faces of different smoothing groups share no normals and faces of group 0 are flat") {
    ObjModel file = empty_file();
    add_triangle(file, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});     // in the plane z = 0
    add_triangle(file, {0, 0, 0}, {0, 1, 0}, {-1, 0, 0.2f}); // and three that are slightly oblique
    add_triangle(file, {0, 0, 0}, {-1, 0, 0.2f}, {0, -1, 0.1f});
    add_triangle(file, {0, 0, 0}, {0, -1, 0.1f}, {1, 0, 0});
    const auto face = [&](std::size_t t) { return vec3(area_of(file, file.triangles[t])); };
    const auto groups = [&](std::vector<int> list) {
        file.smoothing_groups = std::move(list);
        return smooth_normals(file, 180);
    };
    const auto apart = groups({1, 1, 2, 2});
    CHECK(apart[0][0] == approx(normalize(face(0) + face(1))));
    CHECK(apart[1][0] == apart[0][0]);
    CHECK(apart[3][0] == approx(normalize(face(2) + face(3))));
    CHECK_MESSAGE(apart[3][2] == approx(normalize(face(3))), "a vertex that group 1 has too");
    const auto flat = groups({0, 0, -1, -1});
    CHECK(flat[0][0] == approx(normalize(face(0))));
    CHECK(flat[1][0] == approx(normalize(face(1))));
    CHECK(flat[2][0] == approx(normalize(face(2) + face(3))));
    const auto alternating = groups({7, 3, 7, 3});
    CHECK(alternating[2][0] == approx(normalize(face(0) + face(2))));
    CHECK(alternating[1][0] == approx(normalize(face(1) + face(3))));
    const auto together = groups({5, 5, 5, 5}), unstated = groups({});
    for (std::size_t t = 0; t < 4; ++t)
        for (std::size_t k = 0; k < 3; ++k) CHECK(together[t][k] == unstated[t][k]);
}

TEST_CASE("transform replaces the origin that a model has from its file") {
    ObjModel file = empty_file();
    add_triangle(file, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    file.origin = dvec3(5e5, 0, 5e6);
    transform(file, 2, 0, {1, 2, 3});
    CHECK(file.origin == dvec3(0));
    CHECK(file.positions[1] == approx({3, 2, 3}));
}
