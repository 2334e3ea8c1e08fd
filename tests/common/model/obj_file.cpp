// Facts about OBJ files: valid input is read correctly, and an error names its file and line.
#include "common/model/obj_file.h"
#include "common/util/paths.h"

#include "common/util/error.h"
#include "common/model/obj/polygon.h"
#include "tests/check.h"
#include "tests/malformed/folder.h"
#include "tests/malformed/png.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <random>

using namespace rt;
using namespace rt::malformed;

namespace {

const std::string four = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

ObjModel read(const Folder& folder, const std::string& text) {
    return read_obj(folder.write("a.obj", text));
}

ObjModel read(const std::string& text) {
    const Folder folder;
    return read(folder, text);
}

/// Returns the error of reading this text, without the folder's name.
std::string error_of_text(const std::string& text) {
    const Folder folder;
    const std::string path = folder.write("a.obj", text);
    const std::string message = error_of([&] { read_obj(path); });
    CHECK_MESSAGE(message.compare(0, path.size(), path) == 0,
                  ("the message should begin with the path: " + message));
    return message.compare(0, path.size(), path) == 0 ? "a.obj" + message.substr(path.size()) : message;
}

/// Returns what is printed on stderr while this text is read.
std::string warnings_of(const Folder& folder, const std::string& text) {
    const Stderr said;
    read(folder, text);
    return said.text();
}

vec3 area_vector(const std::vector<vec3>& positions, const std::array<ObjIndex, 3>& t) {
    const vec3 a = positions[std::size_t(t[0].position)], b = positions[std::size_t(t[1].position)],
               c = positions[std::size_t(t[2].position)];
    return cross(b - a, c - a) * 0.5f;
}

/// Returns the sum of the triangles' areas, negative for those that run clockwise as seen along `axis`.
float area(const ObjModel& file, vec3 axis) {
    float sum = 0;
    for (const auto& triangle : file.triangles) sum += dot(area_vector(file.positions, triangle), axis);
    return sum;
}

float area(const ObjModel& file) {
    float sum = 0;
    for (const auto& triangle : file.triangles) sum += length(area_vector(file.positions, triangle));
    return sum;
}

/// Returns a polygon in the plane z = 0 as OBJ text, translated and rotated, because the result must not
/// depend on its position.
std::string polygon_text(const std::vector<vec2>& corners, vec3 origin, vec3 right, vec3 up) {
    std::string text, face = "f";
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const vec3 p = origin + right * corners[i].x + up * corners[i].y;
        text += "v " + to_text(p.x) + " " + to_text(p.y) + " " + to_text(p.z) + "\n";
        face += " " + std::to_string(i + 1);
    }
    return text + face + "\n";
}

float shoelace(const std::vector<vec2>& corners) {
    float sum = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const vec2 a = corners[i], b = corners[(i + 1) % corners.size()];
        sum += (a.x * b.y - a.y * b.x) / 2;
    }
    return sum;
}

/// Triangulates the polygon at several positions and orientations, starting from each of its corners.
void check_area_is_kept(std::vector<vec2> corners) {
    const vec3 origins[] = {vec3(0.0f), vec3(5, -7, 3), vec3(-40, 2, 9)};
    const vec3 rights[] = {vec3(1, 0, 0), vec3(0.6f, 0.8f, 0), vec3(0, 0, 1)};
    const vec3 ups[] = {vec3(0, 1, 0), vec3(0, 0, 1), vec3(0.8f, -0.6f, 0)};
    const float expected = shoelace(corners);
    for (std::size_t turn = 0; turn < corners.size(); ++turn) {
        std::rotate(corners.begin(), corners.begin() + 1, corners.end());
        for (const vec3 origin : origins) {
            for (int i = 0; i < 3; ++i) {
                const ObjModel file = read(polygon_text(corners, origin, rights[i], ups[i]));
                CHECK(area(file) == approx(std::abs(expected), 1e-4f)); // no overlap, no excess
                CHECK(area(file, cross(rights[i], ups[i])) ==
                      approx(expected, 1e-4f)); // orientation is preserved
            }
        }
    }
}

} // namespace

// ---- what the format permits

TEST_CASE("the corners of a triangle refer to positions, texture coordinates and normals by index") {
    const ObjModel file = read(four + "vt .1 .2\nvt .3 .4\nvn 0 0 2\nf 1/2/1 2/1/1 3/2/1\n");
    REQUIRE(file.triangles.size() == 1);
    CHECK(file.positions[2] == vec3(1, 1, 0));
    CHECK(file.uvs[1] == vec2(0.3f, 0.4f));
    CHECK(file.normals[0] == vec3(0, 0, 2)); // unnormalised
    CHECK(file.triangles[0][0].position == 0);
    CHECK(file.triangles[0][0].uv == 1);
    CHECK(file.triangles[0][0].normal == 0);
    CHECK(file.triangles[0][2].position == 2);
    CHECK(file.triangle_materials == std::vector<int>{0});
    REQUIRE(file.materials.size() == 1);
    CHECK(file.materials[0].diffuse == vec3(0.6f));
}

TEST_CASE("v, v/vt, v//vn and v/vt/vn may be mixed; a missing index is -1") {
    const ObjModel file = read(four + "vt 0 0\nvn 0 0 1\nf 1 2/1 3//1\nf 1/ 3// 4/1/\n");
    REQUIRE(file.triangles.size() == 2);
    const auto& t = file.triangles[0];
    CHECK((t[0].uv == -1 && t[0].normal == -1));
    CHECK((t[1].uv == 0 && t[1].normal == -1));
    CHECK((t[2].uv == -1 && t[2].normal == 0));
    const auto& u = file.triangles[1]; // a '/' with nothing after it
    CHECK((u[0].uv == -1 && u[1].position == 2 && u[1].normal == -1 && u[2].uv == 0 && u[2].normal == -1));
}

TEST_CASE("negative indices count back from the latest element") {
    const ObjModel file = read(four + "vt 0 0\nvt 1 0\nf -4/-1 -3/-2 -1/-1\nv 9 9 9\nf -5 -4 -2\n");
    REQUIRE(file.triangles.size() == 2);
    for (const auto& t : file.triangles)
        CHECK((t[0].position == 0 && t[1].position == 1 && t[2].position == 3));
    CHECK(file.triangles[0][1].uv == 0);
}

TEST_CASE("a face may precede its vertices even if it is a polygon") {
    const ObjModel file = read("f 1 2 3\nf 1 2 3 4\n" + four);
    CHECK(file.triangles.size() == 3);
    CHECK(area(file) == approx(1.5f));
}

TEST_CASE("comments, groups, objects, smoothing, lines, points and unknown keywords change nothing") {
    const ObjModel file =
        read("# v 9 9 9 \\\n\no thing\ng a b\ns 1\ns off\n" + four +
             "l 1 2 0 99\np 77\nvp 1\nvw x\nt 9/9/9\ncstype bezier\n\tf 1 2\t3 # 4\ng\n  f 1 3 4\n");
    CHECK(file.positions.size() == 4);
    CHECK(file.triangles.size() == 2);
    CHECK(area(file) == approx(1));
}

TEST_CASE("weights, colours and third texture coordinates are ignored whatever their values") {
    const ObjModel file = read(
        "v 0 0 0 1\nv 1 0 0 .5 .5 nan\nv 0 1 0 1e999 # c\nvt 1\nvt 1 2 x\nvn 0 0 1 7\nf 1/1/1 2/2/1 3/2/1\n");
    CHECK(file.positions.size() == 3);
    CHECK(file.uvs[0] == vec2(1, 0));
    CHECK(file.uvs[1] == vec2(1, 2));
}

TEST_CASE("numbers are read in every notation of the format") {
    const ObjModel file = read("v +1 -.5 5.\nv 1e2 1.5E-3 -2e+1\nv 0007 1e-60 "
                               ".0000000000000000000000000000000000000000000000000001\nf 1 2 3\n");
    CHECK(file.positions[0] == vec3(1, -0.5f, 5));
    CHECK(file.positions[1] == approx(vec3(100, 0.0015f, -20), 1e-6f));
    CHECK(file.positions[2] == vec3(7, 0, 0));
}

TEST_CASE("line ends of any system, a byte order mark and a missing last line end are accepted") {
    const std::string expected = four + "f 1 2 3 4\nusemtl x\nf 1 2 3";
    std::string windows, old_mac;
    for (const char c : expected) {
        windows += c == '\n' ? "\r\n" : std::string(1, c);
        old_mac += c == '\n' ? '\r' : c;
    }
    const Stderr said;
    for (const std::string& text :
         {expected, windows, old_mac, "\xef\xbb\xbf" + expected, windows + "\r\n\x1a"}) {
        const ObjModel file = read(text);
        CHECK(file.positions.size() == 4);
        CHECK(file.triangles.size() == 3);
    }
}

TEST_CASE("a backslash joins lines and later lines keep their numbers") {
    const ObjModel file = read("v 0 \\\n0 0\nv 1 0 \\ \n 0\r\nv 0 1 0\nf 1 \\\r\n 2 \\\n 3\n");
    CHECK(file.triangles.size() == 1);
    CHECK_ERROR(error_of_text(four + "f 1 \\\n 2 \\\n 3\nf 1 2 x\n"), "a.obj:8:");
    CHECK_ERROR(error_of_text(four + "f 1 \\\n 2 \\\n x\n"), "a.obj:5:");   // the line where the face begins
    CHECK(read(four + "# a drawing /\\\nf 1 2 3\n").triangles.size() == 1); // a comment joins nothing
    CHECK_ERROR(error_of_text(four + "f 1 2 \\"), "a.obj:5:");
}

// ---- polygons

TEST_CASE("polygons are triangulated without losing or gaining area wherever they are") {
    check_area_is_kept({{0, 0}, {2, 0}, {2, 1}, {0, 1}});
    check_area_is_kept({{0, 10}, {-1, 0}, {0, 1}, {1, 0}}); // an arrow: concave at its third corner
    check_area_is_kept({{2, 0}, {1, 1.7f}, {-1, 1.7f}, {-2, 0}, {-1, -1.7f}, {1, -1.7f}}); // a hexagon
    check_area_is_kept({{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}});                  // an L
    check_area_is_kept({{0, 0}, {1, 0}, {2, 0}, {2, 2}, {1, 2}, {0, 2}, {0, 1}}); // corners on straight edges
    check_area_is_kept({{0, 0}, {4, 0}, {4, 3}, {3, 1}, {2, 3}, {1, 1}, {0, 3}}); // a crown
    check_area_is_kept(
        {{0, 0}, {6, 0}, {6, 6}, {0, 6}, {0, 0}, {2, 2}, {2, 4}, {4, 4}, {4, 2}, {2, 2}}); // a hole
    check_area_is_kept({{0, 0}, {0, 3}, {1, 3}, {1, 1}, {3, 1}, {3, 0}});                  // clockwise
}

TEST_CASE("a quad is split along its shorter diagonal") {
    const ObjModel file = read("v 0 0 0\nv 3 0 0\nv 4 1 0\nv 1 1 0\nf 1 2 3 4\n");
    REQUIRE(file.triangles.size() == 2);
    CHECK(file.triangles[0][0].position == 0);
    CHECK(file.triangles[0][1].position == 1);
    CHECK(file.triangles[0][2].position == 3);
}

TEST_CASE("the triangles of a polygon keep its texture coordinates and materials") {
    const Folder folder;
    folder.write("m.mtl", "newmtl red\nKd 1 0 0\nnewmtl green\nKd 0 1 0\n");
    const ObjModel file = read(folder, "mtllib m.mtl\n" + four +
                                           "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nusemtl green\nf 1/1 2/2 3/3 4/4\n"
                                           "usemtl red\nf 1/1 2/2 3/3\nusemtl green\nf 1/1 2/2 3/3\n");
    CHECK(file.triangle_materials == std::vector<int>{1, 1, 0, 1});
    for (std::size_t i = 0; i < 2; ++i) {
        for (const ObjIndex& corner : file.triangles[i]) CHECK(corner.uv == corner.position);
    }
}

TEST_CASE("triangles without area are omitted with a warning that counts them") {
    const Folder folder;
    const std::string said =
        warnings_of(folder, four + "v 2 0 0\nv 0 0 1e-30\nf 1 2 3\nf 1 2 5\nf 1 1 2\nf 1 2 6\nf 1 2 3 3\n");
    CHECK_ERROR(said, "a.obj: 4 triangles without area");
    CHECK_ERROR(error_of_text(four + "f 1 1 2\n"), "a.obj: none of its faces has an area");
}

TEST_CASE("a normal without direction counts as missing") {
    const ObjModel file = read(four + "vn 0 0 0\nvn 0 0 1\nvn 1e-30 0 0\nf 1//1 2//2 3//3\n");
    CHECK(file.triangles[0][0].normal == -1);
    CHECK(file.triangles[0][1].normal == 1);
    CHECK(file.triangles[0][2].normal == -1);
    for (const vec3& normal : file.normals) CHECK(length(normal) > 0.5f);
}

// ---- errors

TEST_CASE("a position out of range is an error with file, line and valid range") {
    CHECK_ERROR(error_of_text(four + "f 1 2 3\nf 1 2 5\nf 1 2 4\n"), "a.obj:6:", "position 5", "has 4");
    CHECK_ERROR(error_of_text(four + "f 1 2 -5\nv 0 0 0\n"), "a.obj:5:", "position -5", "4 precede it");
    CHECK_ERROR(error_of_text(four + "f 0 1 2\n"), "a.obj:5:", "position 0", "starts at 1");
    CHECK_ERROR(error_of_text(four + "f 1 2 -0\n"), "a.obj:5:", "position 0");
    CHECK_ERROR(error_of_text(four + "f 1 2 4294967297\n"), "a.obj:5:", "position");
    CHECK_ERROR(error_of_text(four + "f 1 2 18446744073709551617\n"), "a.obj:5:", "position");
    CHECK_ERROR(error_of_text(four + "f 1 2 -18446744073709551615\n"), "a.obj:5:", "position");
    CHECK_ERROR(error_of_text(four + "f 1 2 2147483647\n"), "a.obj:5:", "position 2147483647");
}

TEST_CASE("a corner that is not an index is an error with file and line") {
    for (const char* corner :
         {"x", "1.5", "1e2", "2/", "/2", "1/x", "1//x", "1/2/3/4", "1///2", "+", "-", "1-2", "--1"})
        CHECK_ERROR(error_of_text(four + "f 1 " + corner + "\n"), "a.obj:5:");
    CHECK_ERROR(error_of_text(four + "f 1 2 3.5\n"), "a.obj:5:", "\"3.5\"");
    CHECK_ERROR(error_of_text(four + std::string("f 1 2 3\0", 8) + " 4\n"), "a.obj:5:");
}

TEST_CASE("a face of fewer than three corners is an error with file and line") {
    CHECK_ERROR(error_of_text(four + "f 1 2\n"), "a.obj:5:", "three corners", "has 2");
    CHECK_ERROR(error_of_text(four + "f\n"), "a.obj:5:", "has 0");
    CHECK_ERROR(error_of_text(four + "f 1 2 # 3\n"), "a.obj:5:", "has 2");
}

TEST_CASE("a number that is invalid or too large for a double is an error with file and line") {
    for (const char* word : {"nan", "inf", "-inf", "NaN", "1e999", "0e999", "-4e38999999999999", "abc", "1,5",
                             "1.0f", "0x10", "1e", "1e+", ".", "-", "--1", "1.2.3", "1e5.5", "\"1\""})
        CHECK_ERROR(error_of_text(four + "v 0 " + word + " 0\nf 1 2 3\n"), "a.obj:5:", word, "number");
    CHECK_ERROR(error_of_text("v 0 1\n" + four), "a.obj:1:", "3 numbers", "has 2");
    CHECK_ERROR(error_of_text("v\n" + four), "a.obj:1:", "has 0");
    CHECK_ERROR(error_of_text(four + "vn 0 nan 0\nvn 0 x 0\n"), "a.obj:6:", "\"x\" is not a number");
    CHECK_ERROR(error_of_text(four + "vn 0 1\n"), "a.obj:5:", "has 2");
    CHECK_ERROR(error_of_text(four + "vt 1,5 0\n"), "a.obj:5:", "1,5");
    CHECK_ERROR(error_of_text(four + "vt\n"), "a.obj:5:", "1 number");
    CHECK_ERROR(error_of_text("\xef\xbb\xbfv 0 x 0\r\n"), "a.obj:1:", "\"x\" is not a number");
}

TEST_CASE("a file that is missing, a folder, empty or without faces is an error") {
    const Folder folder;
    CHECK_ERROR(error_of([&] { read_obj(folder / "none.obj"); }), "none.obj", "no such file");
    CHECK_ERROR(error_of([&] { read_obj(text_of(folder.path)); }), "is a folder");
    CHECK_ERROR(error_of_text(""), "a.obj: is empty");
    CHECK_ERROR(error_of_text(four), "a.obj: has no faces");
    CHECK_ERROR(error_of_text("\n"), "no faces");
    CHECK_ERROR(error_of_text("solid cube\nfacet normal 0 0 1\n"), "no faces", "is it an OBJ file?");
    CHECK_ERROR(error_of_text(std::string("\xff\xfe"
                                          "v\0 \0",
                                          6)),
                "a.obj:1:", "is this an OBJ file?");
}

TEST_CASE("100 MB of noise are rejected immediately with one short line") {
    const Folder folder;
    std::string noise(100 << 20, '\0');
    std::mt19937_64 random(1);
    for (std::size_t i = 0; i < noise.size(); i += 8) {
        const std::uint64_t bits = random();
        std::copy_n(reinterpret_cast<const char*>(&bits), 8, noise.begin() + std::ptrdiff_t(i));
    }
    const std::string path = folder.write("noise.obj", noise);
    const auto start = std::chrono::steady_clock::now();
    const std::string message = error_of([&] { read_obj(path); });
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    CHECK_ERROR(message, "noise.obj:1:", "not text");
    CHECK(message.size() < path.size() + 100);
    CHECK(seconds < 5); // tenths of a second on an idle machine
}

// ---- chunks and threads

namespace {

const ObjReadOptions readings[] = {{1, 1}, {1, 17}, {2, 40}, {5, 100}, {3, 1}, {2, 1 << 20}};

/// Builds a text that uses everything a chunk cannot resolve alone: indices that refer back and ahead,
/// joined lines, materials, libraries.
std::string text_of_many_chunks() {
    std::string text = "\xef\xbb\xbfmtllib m.mtl\nf 1/1/1 2/2/1 \\\n\\\n 3/1/1\n";
    for (int i = 0; i < 50; ++i) {
        const std::string n = std::to_string(i + 1);
        text += "v " + n + " 0 " + std::to_string(i * i) + ".5\r\nv 0 " + n + " 0 # c\nvt " + n +
                " 1\nvn 0 " + n + " 1\n";
        if (i >= 9) text += "usemtl a" + std::to_string(i % 3) + "\nf -20/-10 -1//-3 \\\n -2/-1/-10 3 -7\n";
        if (i == 20) text += "mtllib n.mtl\nmtllib m.mtl \n\n#\\\n\r\r";
    }
    return text + "f 1 99 100";
}

bool same(const ObjModel& a, const ObjModel& b) {
    const auto same_corner = [](const ObjIndex& c, const ObjIndex& d) {
        return c.position == d.position && c.uv == d.uv && c.normal == d.normal;
    };
    const auto same_corners = [&](const auto& t, const auto& u) {
        return std::equal(t.begin(), t.end(), u.begin(), same_corner);
    };
    const auto same_material = [](const ObjMaterial& m, const ObjMaterial& n) {
        return m.name == n.name && m.diffuse == n.diffuse;
    };
    return a.positions == b.positions && a.normals == b.normals && a.uvs == b.uvs &&
           a.triangle_materials == b.triangle_materials &&
           std::ranges::equal(a.triangles, b.triangles, same_corners) &&
           std::ranges::equal(a.materials, b.materials, same_material);
}

/// Checks that the error of a text is the same for all ways of reading it, and returns the error.
std::string error_in_any_chunks(const std::string& text) {
    const Folder folder;
    const std::string path = folder.write("a.obj", text);
    const std::string whole = error_of([&] { read_obj(path); });
    for (const ObjReadOptions& reading : readings) {
        CAPTURE(reading.threads);
        CAPTURE(reading.chunk_bytes);
        CHECK(error_of([&] { read_obj(path, reading); }) == whole);
    }
    return whole;
}

} // namespace

TEST_CASE("a file and its warnings are the same for any chunk size and number of threads") {
    const Folder folder;
    folder.write("m.mtl", "newmtl a0\nKd 1 0 0\nnewmtl a1\nKd 0 1 0\n");
    folder.write("n.mtl", "newmtl a2\nKd 0 0 1\n");
    const std::string path = folder.write("a.obj", text_of_many_chunks());
    const Stderr said;
    const ObjModel whole = read_obj(path, {1, 1 << 20});
    CHECK(whole.triangles.size() == 125);
    CHECK(whole.positions.size() == 100);
    CHECK(whole.triangles[1][0].position == 0); // -20 with 20 positions before it
    CHECK(whole.materials.size() == 4); // includes the default: a2 is used before its library is named
    CHECK_ERROR(said.text(), "1 of 43 faces wind against their normals");
    for (const ObjReadOptions& reading : readings) {
        CAPTURE(reading.threads);
        CAPTURE(reading.chunk_bytes);
        const Stderr again;
        CHECK(same(read_obj(path, reading), whole));
        CHECK(again.text() == said.text());
    }
}

TEST_CASE("an error names its line in whichever chunk it is") {
    std::string before = four + "f 1 2 \\\n 3\r\n"; // six lines
    for (int line = 7; line < 60; line += 6) {
        CHECK_ERROR(error_in_any_chunks(before + "f 1 2 x\nf 1 2 3\nv y\n"), ":" + std::to_string(line) + ":",
                    "\"x\"");
        CHECK_ERROR(error_in_any_chunks(before + "f 1 2 -5\nf 1 2 z\n"), ":" + std::to_string(line) + ":",
                    "position -5, but only 4 precede it");
        CHECK_ERROR(error_in_any_chunks(before + "f 1 2 5\nf 1 2 6\nf 1 2 6\n"),
                    ":" + std::to_string(line + 1) + ":", "position 6", "has 4");
        before += "# a\nf -4 -3 -1\r\n\n#\\\n\rf 1 2 4 3\n";
    }
}

TEST_CASE("the first of several errors is reported whichever thread finds one first") {
    std::string text = four;
    for (int i = 0; i < 20000; ++i) text += i % 4000 == 3999 ? "f 1 2 wrong\n" : "f 1 2 3\n";
    const Folder folder;
    const std::string path = folder.write("a.obj", text);
    for (int i = 0; i < 20; ++i) CHECK_ERROR(error_of([&] { read_obj(path, {4, 5000}); }), "a.obj:4004:");
}

TEST_CASE("a library that is named twice is read once even with blanks after its name") {
    const Folder folder;
    const Stderr said;
    const std::string once = warnings_of(folder, "mtllib none.mtl\n" + four + "f 1 2 3\n");
    CHECK(warnings_of(folder, "mtllib none.mtl \nmtllib none.mtl \n" + four + "f 1 2 3\n") == once);
}

// ---- materials

TEST_CASE("an .mtl file states colours, emission, reflectivity, index of refraction and transparency") {
    const Folder folder;
    folder.write("m.mtl", "# comment\nnewmtl a\nKd .1 .2 .3\nKe 5 6 7\nKs .3 .6 .9\nillum 3\nNi 1.33\nNs 20\n"
                          "newmtl b\nKd .5\nKs 1 1 1\nillum 2\nNi 1.5\nd .2\n"
                          "newmtl c\nPm .75\nillum 7\nNi 1.52\n"
                          "newmtl d\nd .2\n"
                          "newmtl e\nNi 1.5\nTr .9\n"
                          "newmtl f\nKe 1 1 1\nd -halo 1\n");
    std::string text = "mtllib m.mtl\n" + four;
    for (const char* name : {"a", "b", "c", "d", "e", "f"})
        text += std::string("usemtl ") + name + "\nf 1 2 3\n";
    const Stderr said;
    const std::vector<ObjMaterial> list = read(folder, text).materials;
    const std::string warnings = said.text();
    CHECK_ERROR(warnings, "is drawn opaque (material \"d\")");
    CHECK(std::count(warnings.begin(), warnings.end(), '\n') == 1);
    REQUIRE(list.size() == 6);
    CHECK(list[0].name == "a");
    CHECK(list[0].diffuse == approx(vec3(0.1f, 0.2f, 0.3f)));
    CHECK(list[0].emission == approx(vec3(5, 6, 7)));
    CHECK(list[0].reflectivity == approx(0.6f));
    CHECK(list[0].ior == approx(1.33f));
    CHECK_FALSE(list[0].glass);
    CHECK(list[0].texture == -1);
    CHECK(list[1].diffuse == vec3(0.5f)); // a single number applies to all three
    CHECK(list[1].reflectivity == 0);     // illum 2: a highlight, not a mirror
    CHECK(list[1].glass);                 // d < 1 and Ni > 1
    CHECK(list[2].reflectivity == approx(0.75f));
    CHECK(list[2].glass);
    CHECK(list[2].ior == approx(1.52f));
    CHECK(list[2].diffuse == vec3(0.6f)); // no Kd: grey
    CHECK_FALSE(list[3].glass);           // d < 1 alone is not glass
    CHECK(list[4].glass);
    CHECK(list[5].diffuse == vec3(0.0f)); // a lamp reflects nothing unless Kd is given
}

TEST_CASE("only the materials that are used are listed and each of them once") {
    const Folder folder;
    folder.write("m.mtl", "newmtl unused\nmap_Kd none.png\nnewmtl used\nKd 0 0 1\n");
    const Stderr said;
    const ObjModel file =
        read(folder, "mtllib m.mtl\n" + four + "usemtl used\nf 1 2 3\nusemtl used\nf 1 3 4\n");
    REQUIRE(file.materials.size() == 1);
    CHECK(file.materials[0].name == "used");
    CHECK(file.textures.empty());
    CHECK(said.text() == "");
}

TEST_CASE("numbers out of range are clamped with a warning that names file, material and value") {
    const Folder folder;
    folder.write("m.mtl", "newmtl a\nKd 1.5 -1 .5\nKe -2 0 0\nNi .5\nPm 3\n");
    const Stderr said;
    const ObjMaterial a = read(folder, "mtllib m.mtl\n" + four + "usemtl a\nf 1 2 3\n").materials[0];
    CHECK(a.diffuse == vec3(1, 0, 0.5f));
    CHECK(a.emission == vec3(0.0f));
    CHECK(a.ior == 1);
    CHECK(a.reflectivity == 1);
    CHECK_ERROR(said.text(), "m.mtl: material \"a\": Kd is 1.5", "Kd is -1", "Ke is -2", "Ni is 0.5",
                "Pm is 3");
}

TEST_CASE("an invalid number in an .mtl file is an error with file and line") {
    const auto error_of_mtl = [](const std::string& text) {
        const Folder folder;
        folder.write("m.mtl", text);
        return error_of([&] { read(folder, "mtllib m.mtl\n" + four + "f 1 2 3\n"); });
    };
    CHECK_ERROR(error_of_mtl("newmtl a\nKd 0 nan 0\n"), "m.mtl:2:", "\"nan\" is not a number");
    CHECK_ERROR(error_of_mtl("newmtl a\r\n\r\nKe 1e999 0 0\r\n"), "m.mtl:3:", "too large");
    CHECK_ERROR(error_of_mtl("newmtl a\nKd 1 1\n"), "m.mtl:2:", "three numbers");
    CHECK_ERROR(error_of_mtl("newmtl a\nKd\n"), "m.mtl:2:", "three numbers");
    CHECK_ERROR(error_of_mtl("newmtl a\nNi\n"), "m.mtl:2:", "needs a number");
    CHECK_ERROR(error_of_mtl("newmtl a\nNi # 2\n"), "m.mtl:2:", "needs a number");
    CHECK_ERROR(error_of_mtl("newmtl a\nillum glass\n"), "m.mtl:2:", "\"glass\"");
    CHECK_ERROR(error_of_mtl("newmtl a\nd -halo\n"), "m.mtl:2:", "needs a number");
    CHECK_ERROR(error_of_mtl("newmtl\n"), "m.mtl:1:", "names no material");
    CHECK(error_of_mtl("newmtl a\nmap_Bump nan\nNs nan\nKa x y z\n") == "no error"); // unused keywords
}

TEST_CASE("a missing .mtl file gives grey and one warning with the paths that were tried") {
    const Folder folder;
    const Stderr said;
    const ObjModel file =
        read(folder, "mtllib sub/none.mtl\n" + four + "usemtl a\nf 1 2 3\nusemtl b\nf 1 3 4\n");
    REQUIRE(file.materials.size() == 1);
    CHECK(file.materials[0].diffuse == vec3(0.6f));
    CHECK_ERROR(said.text(), "a.obj", "\"sub/none.mtl\" not found", folder / "sub/none.mtl",
                folder / "none.mtl");
    const std::string text = said.text();
    CHECK(std::count(text.begin(), text.end(), '\n') == 1);
}

TEST_CASE("undefined materials are grey with a warning") {
    const Folder folder;
    folder.write("m.mtl", "newmtl a\nKd 1 0 0\n");
    CHECK_ERROR(warnings_of(folder, "mtllib m.mtl\n" + four + "usemtl b c\nf 1 2 3\nusemtl a\nf 1 2 3\n"),
                "a.obj:6: material \"b?c\"", "grey");
    CHECK_ERROR(warnings_of(folder, four + "usemtl b\nf 1 2 3\n"), "no material file (mtllib)");
    CHECK(warnings_of(folder, "mtllib m.mtl\n" + four + "usemtl a\nf 1 2 3\n") == "");
    const Stderr said;
    const ObjModel file = read(folder, "mtllib m.mtl\n" + four + "f 1 2 3\nusemtl a\nf 1 3 4\n");
    CHECK(file.triangle_materials ==
          std::vector<int>{1, 0}); // faces before the first usemtl have the default material, which is last
}

TEST_CASE("several .mtl files, names with spaces, backslashes and relative folders are supported") {
    const Folder folder;
    folder.write("one.mtl", "newmtl one\nKd 1 0 0\n");
    folder.write("sub/two.mtl", "newmtl two\nKd 0 1 0\n");
    folder.write("my own.mtl", "newmtl  my colour \nKd 0 0 1\n");
    folder.write("below/a.obj",
                 "mtllib ..\\one.mtl ../sub/two.mtl\nmtllib C:\\art\\my own.mtl\nmtllib ../my own.mtl\n" +
                     four + "usemtl one\nf 1 2 3\nusemtl two\nf 1 2 3\nusemtl   my colour\nf 1 2 3\n");
    const Stderr said;
    const std::vector<ObjMaterial> list = read_obj(folder / "below/a.obj").materials;
    REQUIRE(list.size() == 3);
    CHECK(list[0].diffuse == vec3(1, 0, 0));
    CHECK(list[1].diffuse == vec3(0, 1, 0));
    CHECK(list[2].diffuse == vec3(0, 0, 1));
    CHECK(list[2].name == "my colour");
}

// ---- textures

TEST_CASE("a texture is found beside the .mtl, beside the .obj or by its bare name; each is loaded once") {
    const Folder folder;
    const auto grey = [](char value) { return png(1, 1, 8, 0, std::string(1, '\0') + value); };
    folder.write("lib/near mtl.png", grey(10));
    folder.write("near_obj.png", grey(20));
    folder.write("lib/m.mtl",
                 "newmtl a\nmap_Kd near mtl.png\nnewmtl b\nKd .5 .5 .5\nmap_Kd -s 2 2 near_obj.png\n"
                 "newmtl c\nmap_Kd -o 1 -bm 2 -clamp on C:\\somebody\\else\\near mtl.png  \n"
                 "newmtl d\nmap_kd ../lib/./near mtl.png\n");
    std::string text = "mtllib lib/m.mtl\n" + four;
    for (const char* name : {"a", "b", "c", "d"}) text += std::string("usemtl ") + name + "\nf 1 2 3\n";
    const Stderr said;
    const ObjModel file = read(folder, text);
    REQUIRE(file.textures.size() == 2);
    CHECK(file.textures[0].values[0] == 10 * 257);
    CHECK(file.textures[1].values[0] == 20 * 257);
    REQUIRE(file.materials.size() == 4);
    CHECK(file.materials[0].texture == 0);
    CHECK(file.materials[1].texture == 1);
    CHECK(file.materials[2].texture == 0);
    CHECK(file.materials[3].texture == 0);
    CHECK(file.materials[0].diffuse == vec3(1.0f)); // no Kd: only the texture determines the colour
    CHECK(file.materials[1].diffuse == vec3(0.5f));
    CHECK_ERROR(said.text(), "m.mtl:5: the texture option -s is not supported", "m.mtl:7:");
}

TEST_CASE("a missing or unreadable texture becomes a magenta checkerboard with a warning that lists paths "
          "and reason") {
    const Folder folder;
    folder.write("lib/m.mtl",
                 "newmtl a\nmap_Kd art/none.png\nnewmtl b\nmap_Kd art/none.png\nnewmtl c\nmap_Kd bad.png\n"
                 "newmtl d\nmap_Kd .\n");
    folder.write("bad.png", "not a picture");
    std::string text = "mtllib lib/m.mtl\n" + four;
    for (const char* name : {"a", "b", "c", "d"}) text += std::string("usemtl ") + name + "\nf 1 2 3\n";
    const Stderr said;
    const ObjModel file = read(folder, text);
    REQUIRE(file.textures.size() == 3);
    CHECK(file.materials[0].texture == file.materials[1].texture);
    const Bitmap& checker = file.textures[0];
    REQUIRE(checker.values.size() == std::size_t(3 * checker.width * checker.height));
    CHECK(checker.values[0] == 65535);
    CHECK(checker.values[1] == 0);
    CHECK(checker.values[2] == 65535);
    CHECK(checker.values[3] == 0);
    CHECK_ERROR(said.text(), "\"art/none.png\" cannot be used", folder / "lib/art/none.png",
                folder / "lib/none.png", folder / "art/none.png", folder / "none.png", "no such file",
                "\"bad.png\"", "is damaged");
    const std::string all = said.text();
    CHECK(std::count(all.begin(), all.end(), '\n') == 3);
}

// ---- a third-party model

TEST_CASE("the bunny of glmark2-data is read completely") {
    const std::string path = "/usr/share/glmark2/models/bunny.obj";
    if (!fs::exists(path)) {
        SKIP_CHECK("no " + path + " (Debian's package glmark2-data)");
        return;
    }
    const ObjModel file = read_obj(path);
    CHECK(file.triangles.size() == 69666);
    CHECK(file.positions.size() == 34835);
    CHECK(file.normals.empty());
    CHECK(file.triangles[0][0].normal == -1);
    CHECK(std::abs(area(file) - 9.603f) < 0.01f);
}
