// Facts about the geometry of OBJ files.
// Distant origins, extreme sizes, winding against normals, colours, smoothing groups, lines that are ignored
// in part, and independence from chunk sizes.
#include "common/util/error.h"
#include "common/model/obj_file.h"
#include "tests/check.h"
#include "tests/malformed/folder.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <random>

using namespace rt;
using namespace rt::malformed;

namespace {

const std::string four = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

struct Reading {
    ObjModel file;
    std::string said; ///< on stderr, or the error, with "a.obj" as the path
};

Reading read(const std::string& text, const ObjReadOptions& how = {}) {
    const Folder folder;
    const std::string path = folder.write("a.obj", text);
    const Stderr said;
    Reading reading;
    try {
        reading.file = read_obj(path, how);
        reading.said = said.text();
    } catch (const Error& error) {
        reading.said = said.text() + "error: " + error.what();
    }
    for (std::size_t i; (i = reading.said.find(path)) != std::string::npos;)
        reading.said.replace(i, path.size(), "a.obj");
    return reading;
}

template <typename... Numbers>
std::string line(const char* format, Numbers... numbers) {
    char text[200];
    const int length = std::snprintf(text, sizeof text, format, numbers...);
    return std::string(text, std::size_t(length)) + "\n";
}

/// Builds city blocks, 450 m wide: each house is a box of four walls and a roof,
/// with coordinates in millimetres.
std::string city(const dvec3& corner) {
    std::string text, faces;
    for (int i = 0; i < 64; ++i) {
        const dvec3 low = corner + dvec3(i % 8 * 60.125, 0, i / 8 * 60.033);
        const dvec3 high = low + dvec3(30.001, 7 + i * i % 53, 29.999);
        for (int k = 0; k < 8; ++k)
            text += line("v %.3f %.3f %.3f", k & 1 ? high.x : low.x, k & 2 ? high.y : low.y,
                         k & 4 ? high.z : low.z);
        const int n = 8 * i;
        faces += line("f %d %d %d %d", n + 3, n + 7, n + 8, n + 4) +
                 line("f %d %d %d %d", n + 1, n + 2, n + 4, n + 3) +
                 line("f %d %d %d %d", n + 5, n + 7, n + 8, n + 6);
    }
    return text + faces;
}

bool same_corners(const ObjModel& a, const ObjModel& b) {
    const auto same = [](const ObjIndex& c, const ObjIndex& d) {
        return c.position == d.position && c.uv == d.uv && c.normal == d.normal;
    };
    return std::ranges::equal(a.triangles, b.triangles, [&](const auto& t, const auto& u) {
        return std::equal(t.begin(), t.end(), u.begin(), same);
    });
}

/// Compares everything except materials, bit by bit.
bool same_geometry(const ObjModel& a, const ObjModel& b) {
    return a.origin == b.origin && a.positions == b.positions && a.normals == b.normals && a.uvs == b.uvs &&
           a.colors == b.colors && a.smoothing_groups == b.smoothing_groups &&
           a.triangle_materials == b.triangle_materials && same_corners(a, b);
}

vec3 area_vector(const ObjModel& file, std::size_t triangle) {
    const auto at = [&](std::size_t k) {
        return file.positions[std::size_t(file.triangles[triangle][k].position)];
    };
    return cross(at(1) - at(0), at(2) - at(0));
}

/// Builds a ball of triangles with the diameter `size`.
std::string ball(double size, const dvec3& center) {
    std::string text, faces;
    for (int i = 0; i <= 6; ++i)
        for (int j = 0; j < 12; ++j) {
            const double down = 3.14159265 * i / 6, around = 3.14159265 * j / 6;
            const dvec3 p(std::sin(down) * std::cos(around), std::cos(down),
                          -std::sin(down) * std::sin(around));
            const dvec3 q = center + size / 2 * p;
            text += line("v %.9e %.9e %.9e", q.x, q.y, q.z);
            const int a = 12 * i + j + 1, b = 12 * i + (j + 1) % 12 + 1;
            if (i > 0 && i < 6) faces += line("f %d %d %d", a, b, a - 12);
            if (i > 0) faces += i > 1 ? line("f %d %d %d", b, b - 12, a - 12) : "";
        }
    return text + faces;
}

} // namespace

// ---- far from the origin

TEST_CASE("a model far from the origin gets a local origin before its coordinates become floats") {
    const dvec3 far(500000, 0, 5000000);
    const ObjModel here = read(city(dvec3(0))).file, there = read(city(far)).file;
    CHECK(here.origin == dvec3(0));
    CHECK_MESSAGE(glm::distance(there.origin, far) < 1000, "the origin must be near the middle of the model");
    CHECK_MESSAGE(there.origin == round(there.origin), "the origin must be a whole number");
    REQUIRE(there.positions.size() == here.positions.size());
    double worst = 0;
    for (std::size_t i = 0; i < here.positions.size(); ++i)
        worst = std::max(
            worst, glm::distance(dvec3(there.positions[i]) + there.origin, dvec3(here.positions[i]) + far));
    CHECK_MESSAGE(worst < 1e-4, "metres; as floats these coordinates would be off by up to 0.25");
    CHECK(same_corners(here, there));
}

TEST_CASE("a model near the origin is not shifted") {
    for (const double away : {0.0, 1.0, 7.0}) CHECK(read(ball(1, dvec3(away, 0, 0))).file.origin == dvec3(0));
    CHECK(read(ball(1, dvec3(30, 0, 0))).file.origin.x == doctest::Approx(30));
    CHECK(read(ball(1e-3, dvec3(0.5, 2.25, 0))).file.origin.y == doctest::Approx(2.25));
}

TEST_CASE("only vertices that a face uses determine the origin") {
    const std::string far = "v 1e6 1e6 0\nv 1000001 1e6 0\nv 1e6 1000001 0\n";
    const ObjModel moved = read("v 0 0 0\n" + far + "v 0 0 0\nf 2 3 4\n").file;
    CHECK(moved.origin.x == doctest::Approx(1e6));
    for (const auto k : {1u, 2u, 3u}) CHECK(length(moved.positions[k]) < 1);
    const Reading odd = read(four + "v 1e300 0 0\nv 3e38 3e38 1e39\nf 1 2 3\n");
    CHECK(odd.said == "");
    CHECK(odd.file.origin == dvec3(0));
    REQUIRE(odd.file.positions.size() == 6);
    for (const vec3 p : odd.file.positions) CHECK((std::isfinite(p.x) && std::isfinite(p.z)));
}

// ---- very large and very small

TEST_CASE("a model of any size from 1e-15 to 1e15 keeps all of its triangles") {
    const Reading plain = read(ball(1, dvec3(0)));
    REQUIRE(plain.said == "");
    REQUIRE(plain.file.triangles.size() == 120);
    for (const double size : {1e-15, 1e-12, 1e-9, 1e-4, 1e4, 1e9, 1e12, 1e15}) {
        CAPTURE(size);
        const Reading scaled = read(ball(size, dvec3(0)));
        CHECK(scaled.said == "");
        CHECK(same_corners(scaled.file, plain.file));
    }
}

TEST_CASE("a model that is too large or too small is rejected because of its size and not because of missing "
          "area") {
    for (const char* size : {"1e-20", "1e-30", "1e18", "1e30", "1e38", "3e38", "1e300"}) {
        const std::string one(size);
        const std::string said = read("v 0 0 0\nv " + one + " 0 0\nv 0 " + one + " 0\nf 1 2 3\n").said;
        CHECK_ERROR(said, "error: a.obj: is ", " across (position 2 is the farthest out)", "scale it");
    }
    CHECK(read("v 2 2 2\nf 1 1 1\n").said == "error: a.obj: none of its faces has an area");
}

TEST_CASE("triangles without area are omitted at any size") {
    for (const double s : {1e-12, 1.0, 1e12}) {
        const Reading flat = read(line("v 0 0 0\nv %g 0 0\nv %g %g 0\nv %g 0 0", s, s, s, 2 * s) +
                                  "f 1 2 3\nf 1 2 4\nf 1 1 2\n");
        CHECK(flat.said == "warning: a.obj: 2 triangles without area are left out\n");
        CHECK(flat.file.triangles.size() == 1);
    }
}

// ---- winding against normals

TEST_CASE("faces that wind against their normals are reversed with their uvs and normals, and counted") {
    const Reading reading =
        read(four + "v 2 0 0\nvn 0 0 -1\nvn 0 .1 -1\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvt 2 0\n"
                    "f 1/1/1 2/2/1 3/3/2 4/4/2\nf 5/5/1 2/2/1 3/3/1\nf 1 2 3\n");
    CHECK(reading.said == "warning: a.obj: 1 of 3 faces wind against their normals and are flipped\n");
    REQUIRE(reading.file.triangles.size() == 4);
    for (const std::size_t i : {0u, 1u, 2u}) {
        CHECK(area_vector(reading.file, i).z < 0);
        for (const ObjIndex& corner : reading.file.triangles[i]) CHECK(corner.uv == corner.position);
    }
    for (const ObjIndex& corner : reading.file.triangles[0])
        CHECK(corner.normal == (corner.position < 2 ? 0 : 1));
    CHECK_MESSAGE(area_vector(reading.file, 3).z > 0, "a face without normals must stay unchanged");
}

TEST_CASE("a concave face is reversed as a whole") {
    const Reading reading = read("v 0 10 0\nv -1 0 0\nv 0 1 0\nv 1 0 0\nv .5 6 0\nvn 0 0 -1\n"
                                 "f 1//1 2//1 3//1 4//1 5//1\n");
    CHECK_ERROR(reading.said, "1 of 1 faces wind against");
    REQUIRE(reading.file.triangles.size() == 3);
    for (std::size_t i = 0; i < 3; ++i) CHECK(area_vector(reading.file, i).z < 0);
}

TEST_CASE("normals that contradict each other, lie in the face or are missing at a corner reverse nothing") {
    for (const char* face : {"f 1//1 2//2 3//3", "f 1//4 2//4 3//4", "f 1//2 2//2 3", "f 1//2 2//2 3//5"}) {
        const Reading reading = read(four + "vn 0 0 1\nvn 0 0 -1\nvn 1 0 0\nvn 0 1 -.01\nvn 0 0 0\n" + face);
        CHECK(reading.said == "");
        CHECK(area_vector(reading.file, 0).z > 0);
    }
}

TEST_CASE("faces that are given twice and once for each side are not contradictory") {
    const std::string quad = four + "vn 0 0 1\nf 1//1 2//1 3//1 4//1\n";
    CHECK(read(quad + "f 4//1 3//1 2//1 1//1\n").said == "");
    CHECK_MESSAGE(read(quad + "vn 0 0 -1\nf 4//2 3//2 2//2 1//2\n").said == "", "with separate normals");
    CHECK_MESSAGE(read(quad + "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 7//1 6//1 5//1\n").said == "",
                  "with separate vertices");
    CHECK_ERROR(read(quad + "v 0 0 3\nf 5//1 3//1 2//1\n").said, "1 of 2 faces wind against");
}

// ---- colours

TEST_CASE("vertex colours are decoded from sRGB values in [0, 1] or from bytes") {
    const ObjModel unit = read("v 0 0 0 1 0 .5\nv 1 0 0\nv 0 1 0 0.03 0 1 # c\nv 0 0 1 .5\nf 1 2 3\n").file;
    REQUIRE(unit.colors.size() == 4);
    CHECK(unit.colors[0] == approx(vec3(1, 0, 0.2140411f), 1e-5f));
    CHECK_MESSAGE(unit.colors[1] == vec3(1), "a vertex without a colour must be white");
    CHECK(unit.colors[2] == approx(vec3(0.03f / 12.92f, 0, 1), 1e-5f));
    CHECK_MESSAGE(unit.colors[3] == vec3(1), "a fourth number alone is a weight");
    const ObjModel bytes = read("v 0 0 0 255 0 127.5\nv 1 0 0 0 1 255\nv 0 1 0\nf 1 2 3\n").file;
    REQUIRE(bytes.colors.size() == 3);
    CHECK(bytes.colors[0] == approx(vec3(1, 0, 0.2140411f), 1e-5f));
    CHECK(bytes.colors[1].y == approx(1 / 255.0f / 12.92f, 1e-5f));
    CHECK(bytes.colors[2] == vec3(1));
    CHECK(read(four + "f 1 2 3\n").file.colors.empty());
    CHECK(read("v 0 0 0 1\nv 1 0 0 .5 .5\nv 0 1 0 0 0 nan\nf 1 2 3\n").file.colors.empty());
}

TEST_CASE("comments of #MRGB colour the vertices in their order") {
    const ObjModel file = read(four + "#MRGB ffff0000ff00FF00\n#MRGB ff0000ff\nf 1 2 3\n").file;
    CHECK(file.colors == std::vector<vec3>{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}});
    CHECK(read(four + "#MRGB zz\n#MRGBfff\nf 1 2 3\n").file.colors.empty());
}

// ---- smoothing groups

TEST_CASE("s lines give each triangle its smoothing group with 0 for off and -1 before the first") {
    const ObjModel file = read(four + "f 1 2 3\ns 2\nf 1 2 3 4\ns off\nf 1 2 3\ns 1\ns 0\nf 1 2 3\ns x\ns\n"
                                      "f 1 2 3\ns on\nf 1 2 3\n")
                              .file;
    CHECK(file.smoothing_groups == std::vector<int>{-1, 2, 2, 0, 0, 0, 1});
    CHECK(read(four + "f 1 2 3\n").file.smoothing_groups.empty());
}

// ---- partly ignored input

TEST_CASE("normals and texture coordinates that are not finite are omitted with a warning that counts them") {
    for (const char* word :
         {"nan", "-nan", "-nan(ind)", "NaN", "inf", "-Infinity", "1.#QNAN", "-1.#IND00", "1e39", "1e999"}) {
        CAPTURE(word);
        const std::string n(word);
        const Reading reading = read(four + "vn 0 0 1\nvn " + n + " 0 0\nvn 0 " + n + " " + n + "\nvt " + n +
                                     "\nvt 0 0\nf 1/1/1 2/2/2 3/2/3\n");
        CHECK(reading.said == "warning: a.obj:6: a normal that is not finite is left out (the first of 2)\n"
                              "warning: a.obj:8: a texture coordinate that is not finite is left out\n");
        REQUIRE(reading.file.triangles.size() == 1);
        const auto& [a, b, c] = reading.file.triangles[0];
        CHECK((a.normal == 0 && b.normal == -1 && c.normal == -1));
        CHECK((a.uv == -1 && b.uv == 1 && c.uv == 1));
        for (const vec3 normal : reading.file.normals) CHECK(std::isfinite(normal.x + normal.y + normal.z));
        for (const vec2 uv : reading.file.uvs) CHECK(std::isfinite(uv.x + uv.y));
    }
}

TEST_CASE("usemtl and mtllib without a name are skipped with a warning") {
    const Reading reading = read(four + "mtllib\nusemtl \nf 1 2 3\nmtllib  \nusemtl\nf 1 3 4\n");
    CHECK(reading.said == "warning: a.obj:6: usemtl names no material; the faces that follow get the default "
                          "one (the first of 2)\n"
                          "warning: a.obj:5: mtllib names no file and is left out (the first of 2)\n");
    CHECK(reading.file.triangle_materials == std::vector<int>{0, 0});
}

TEST_CASE("corners whose normals or texture coordinates do not exist get none and cause a warning") {
    const auto check = [](const std::string& text, const std::string& said, std::size_t kept) {
        const Reading reading = read(four + text);
        CHECK(reading.said == said);
        std::size_t with = 0;
        for (const auto& triangle : reading.file.triangles)
            for (const ObjIndex& c : triangle) with += std::size_t(c.uv >= 0) + std::size_t(c.normal >= 0);
        CHECK(with == kept);
    };
    const std::string normal = "a face vertex names a normal that does not exist and gets none";
    const std::string uv = "a face vertex names a texture coordinate that does not exist and gets none";
    check("f 1//1 2//2 3//3\nf 1 2 3\n", "warning: a.obj:5: " + normal + " (the first of 3)\n", 0);
    check("f 1 2 3\nf 1/1 2/1 3/1\n", "warning: a.obj:6: " + uv + " (the first of 3)\n", 0);
    check("vt 0 0\nf 1/1 2/-2 3/1\n", "warning: a.obj:6: " + uv + "\n", 2);
    check("vt 0 0\nf 1/1 2/0 3/2147483648\n", "warning: a.obj:6: " + uv + " (the first of 2)\n", 1);
    check("vn 0 0 1\nf 1 2 3\n\nf 1 2 \\\n 3//-7 4//1\n", "warning: a.obj:8: " + normal + "\n", 1);
    check("f 1//1 2//1 3//-1\nvn 0 0 1\n", "warning: a.obj:5: " + normal + "\n", 2);
}

// ---- independence from chunk sizes

TEST_CASE("a line that ends in two backslashes joins only the next line") {
    CHECK(read("v 0 0 0\nv 1 0 0\nv 0 1 0\ng a\\\\\n\nf 1 2 3\n").file.triangles.size() == 1);
    CHECK(read("v 0 0 0\nv 1 0 0\nv 0 1 0\ng a\\\\\nf 1 2 3\nf 1 2 3\n").file.triangles.size() == 1);
}

TEST_CASE("a file gives the same model for any chunk size whatever its content") {
    const std::string pieces[] = {"v 1 0 0\n",
                                  "v 0 1 0 .5 .5 1\r\n",
                                  "v 0 0 1\r",
                                  "f 1 2 3\n",
                                  "f -1 -2/-1 -3//-1\n",
                                  "vn 0 0 -1\n",
                                  "vt nan\n",
                                  "vn 0 0 1\n",
                                  "\n",
                                  "\r\n",
                                  "\r\r\n",
                                  " \t\n",
                                  "#c\\\n",
                                  "g a\\\\\n",
                                  "\\\n",
                                  "\\\\\\\n",
                                  "\\ \r\n",
                                  "f 1 \\\n 2 3\n",
                                  "s off\n",
                                  "s 3\\\n",
                                  "usemtl\n",
                                  "usemtl a\n",
                                  "#MRGB ff00ff00ff112233\n",
                                  "\\\r",
                                  "f 1//9 2/8 3\n",
                                  "v 1e30 0 0\n",
                                  "f 1 2\n",
                                  "v 900 900 900\n",
                                  "\\",
                                  "f 3 2 1 1 2\n"};
    std::mt19937 random(29);
    const auto pick = [&](std::size_t count) { return std::size_t(random() % count); };
    for (int round = 0; round < 150; ++round) {
        std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
        for (std::size_t i = 2 + pick(20); i > 0; --i) text += pieces[pick(std::size(pieces))];
        CAPTURE(text);
        const Reading whole = read(text, {1, 1 << 20});
        for (const ObjReadOptions& how :
             {ObjReadOptions{1, 1}, {1, 2 + pick(60)}, {3, 1 + pick(61)}, {2, 61}}) {
            CAPTURE(how.chunk_bytes);
            const Reading cut = read(text, how);
            CHECK(cut.said == whole.said);
            CHECK(same_geometry(cut.file, whole.file));
        }
    }
}

TEST_CASE("a shifted model is the same for any chunk size") {
    const std::string text = city(dvec3(4e5, 20, 5e6)) + "v 0 0 0\n";
    const ObjModel whole = read(text, {1, 1 << 20}).file;
    CHECK(whole.origin != dvec3(0));
    for (const ObjReadOptions& how : {ObjReadOptions{1, 37}, {3, 1000}, {2, 4096}})
        CHECK(same_geometry(read(text, how).file, whole));
}

// ---- long lines

TEST_CASE("megabytes of one line are read in linear time and zeros are rejected immediately") {
    const Folder folder;
    const auto seconds = [&](const std::string& path, const char* expected) {
        const std::clock_t start = std::clock();
        CHECK_ERROR(error_of([&] { read_obj(path, {1, 1 << 16}); }), expected);
        return double(std::clock() - start) / CLOCKS_PER_SEC;
    };
    const auto blanks = [&](int megabytes) {
        return folder.write("blank.obj", std::string(std::size_t(megabytes) << 20, ' ') + "\n");
    };
    // Searching for the line end from the start of each chunk would scan 0.5 and 2 GB.
    const double once = seconds(blanks(8), "has no faces"), twice = seconds(blanks(16), "has no faces");
    CHECK(twice < 3 * once + 0.03);
    const std::string zeros = folder.write("zero.obj", std::string(64 << 20, '\0'));
    CHECK_MESSAGE(seconds(zeros, "zero.obj:1: not text") < 0.05, "only the first megabyte may be examined");
    CHECK_ERROR(read("\xff\xfev").said, "a.obj:1: UTF-16");
}

TEST_CASE("a face has any number of corners") {
    std::string text, face = "f";
    const int count = 70000;
    for (int i = 0; i < count; ++i) {
        text += line("v %.7f %.7f 0", std::cos(6.2831853 * i / count), std::sin(6.2831853 * i / count));
        face += " " + std::to_string(i + 1);
    }
    const Reading reading = read(text + face);
    float area = 0;
    for (std::size_t i = 0; i < reading.file.triangles.size(); ++i)
        area += area_vector(reading.file, i).z / 2;
    CHECK(area == approx(pi, 1e-3f));
}
