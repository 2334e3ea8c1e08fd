// Facts about the materials of OBJ files: cut-outs, spellings of file names, and unsupported features.
#include "common/model/obj/mask.h"
#include "common/model/obj_file.h"
#include "tests/check.h"
#include "tests/malformed/folder.h"
#include "tests/malformed/png.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <ctime>

using namespace rt;
using namespace rt::malformed;

namespace {

/// Builds a model with one face per material, and the line of its .mtl file.
std::string model(const std::string& library_line, const std::string& materials) {
    std::string text = library_line + "\nv 0 0 0\nv 1 0 0\nv 0 1 0\n";
    for (const char name : materials) text.append("usemtl ").append(1, name).append("\nf 1 2 3\n");
    return text;
}

struct Reading {
    ObjModel file;
    std::string warnings;
};

Reading read(const Folder& folder, const std::string& text) {
    const Stderr said;
    ObjModel file = read_obj(folder.write("a.obj", text));
    return {std::move(file), said.text()};
}

/// Reads a model with these materials, which are named a, b, c.
Reading read_mtl(const Folder& folder, const std::string& mtl, const std::string& materials = "a") {
    folder.write("m.mtl", mtl);
    return read(folder, model("mtllib m.mtl", materials));
}

auto lines_of(const std::string& text) {
    return std::count(text.begin(), text.end(), '\n');
}

std::string grey(std::initializer_list<int> values) {
    std::string row(1, '\0');
    for (const int value : values) row += char(value);
    return png(std::uint32_t(values.size()), 1, 8, 0, row);
}

/// Builds an image of grey and alpha values.
std::string grey_alpha(std::initializer_list<int> values) {
    std::string row(1, '\0');
    for (const int value : values) row += char(value);
    return png(std::uint32_t(values.size() / 2), 1, 8, 4, row);
}

using Values = std::vector<std::uint16_t>;

} // namespace

// ---- cut-outs

TEST_CASE("map_d cuts holes by its alpha channel if it has one and otherwise by its raw grey value") {
    const Folder folder;
    folder.write("grey.png", grey({0, 127, 128, 255}));
    folder.write("alpha.png", grey_alpha({200, 0, 0, 255}));
    folder.write("opaque.png", grey_alpha({10, 255, 255, 255}));
    const ObjModel file = read_mtl(folder,
                                   "newmtl a\nmap_d grey.png\nnewmtl b\nmap_d alpha.png\nnewmtl c\nmap_d "
                                   "opaque.png\nnewmtl d\nmap_d -bm 1 ./grey.png\n",
                                   "abcd")
                              .file;
    REQUIRE(file.masks.size() == 3);
    CHECK(file.masks[0].width == 4);
    CHECK(file.masks[0].height == 1);
    CHECK(file.masks[0].opacity ==
          Values{0, 127 * 257, 128 * 257, 65535}); // 127 is below one half, 128 is not
    CHECK(file.masks[1].opacity == Values{0, 65535});
    CHECK(file.masks[2].opacity == Values{10 * 257, 65535});
    const int expected[] = {0, 1, 2, 0};
    for (std::size_t i = 0; i < 4; ++i) CHECK(file.materials[i].mask == expected[i]);
    CHECK(file.textures.empty());
}

TEST_CASE("the alpha of map_Kd cuts holes if there is no map_d") {
    const Folder folder;
    folder.write("leaf.png", grey_alpha({200, 255, 50, 0}));
    folder.write("white.png", grey({255}));
    const ObjModel file = read_mtl(folder,
                                   "newmtl a\nmap_Kd leaf.png\nnewmtl b\nmap_Kd leaf.png\nmap_d "
                                   "white.png\nnewmtl c\nmap_Kd leaf.png\n",
                                   "abc")
                              .file;
    REQUIRE(file.masks.size() == 1);
    CHECK(file.masks[0].opacity == Values{65535, 0});
    CHECK(file.materials[0].mask == 0);
    CHECK_MESSAGE(file.materials[1].mask == -1, "map_d states that there are no holes");
    CHECK(file.materials[2].mask == 0);
    CHECK(file.textures.size() == 1);
}

TEST_CASE("a mask without a hole and the mask of glass are omitted") {
    const Folder folder;
    folder.write("thin.png", grey({128, 255}));
    folder.write("grid.png", grey({0, 255}));
    const Reading reading = read_mtl(folder,
                                     "newmtl a\nmap_d thin.png\nnewmtl b\nillum 7\nNi 1.5\nmap_d grid.png\n"
                                     "newmtl c\nmap_d none.png\n",
                                     "abc");
    CHECK(reading.file.masks.empty());
    for (const ObjMaterial& material : reading.file.materials) CHECK(material.mask == -1);
    CHECK_ERROR(reading.warnings, "\"none.png\" cannot be used, its material has no holes");
    CHECK(lines_of(reading.warnings) == 1);
}

TEST_CASE("the colour hidden in a hole does not bleed into its edge") {
    Bitmap bitmap{5, 1, {}, {65535, 65535, 0, 0, 0}, ""};
    for (const std::uint16_t value : {1000, 3000, 9, 9, 9})
        bitmap.values.insert(bitmap.values.end(), 3, value);
    fill_hidden_colours(bitmap);
    const auto value = [&](std::size_t x) { return bitmap.values[3 * x]; };
    CHECK(value(0) == 1000);
    CHECK(value(1) == 3000);
    CHECK(value(2) == 3000);
    CHECK_MESSAGE(value(4) == 1000, "the texture repeats: its last column is next to its first");
    CHECK(value(3) == 2000); // from the second pass
    CHECK(bitmap.opacity == Values{65535, 65535, 0, 0, 0});
    Bitmap gone{1, 1, {5, 6, 7}, {0}, ""};
    fill_hidden_colours(gone);
    CHECK(gone.values == Values{5, 6, 7}); // no known colour
}

// ---- file names

TEST_CASE("names in quotes are read as Metashape writes them") {
    const Folder folder;
    folder.write("my scan.mtl",
                 "newmtl \"a b\"\nmap_Kd \"my wall.png\"\nnewmtl c\nmap_Kd -s 1 1 \"my wall.png\"\n");
    folder.write("c.mtl", "newmtl d\nKd 1 0 0\n");
    folder.write("my wall.png", grey({7}));
    const Reading reading =
        read(folder, "mtllib \"my scan.mtl\" \"c.mtl\"\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl \"a b\"\n"
                     "f 1 2 3\nusemtl a b\nf 1 2 3\nusemtl \"c\"\nf 1 2 3\nusemtl d\nf 1 2 3\n");
    REQUIRE(reading.file.materials.size() == 3);
    CHECK(reading.file.materials[0].name == "a b");
    CHECK(reading.file.triangle_materials == std::vector<int>{0, 0, 1, 2});
    REQUIRE(reading.file.textures.size() == 1);
    CHECK(reading.file.textures[0].values[0] == 7 * 257);
    CHECK(lines_of(reading.warnings) == 1); // for -s
}

TEST_CASE("a backslash before a space escapes it and before a letter it is a path separator") {
    const Folder folder;
    folder.write("my own.mtl", "newmtl a\nmap_Kd my\\ wall.png\nnewmtl b\nmap_Kd art\\wood.png\n");
    folder.write("my wall.png", grey({7}));
    folder.write("art/wood.png", grey({9}));
    const Reading reading = read(folder, model("mtllib my\\ own.mtl", "ab"));
    CHECK(reading.warnings == "");
    REQUIRE(reading.file.textures.size() == 2);
    CHECK(reading.file.textures[0].values[0] == 7 * 257);
    CHECK(reading.file.textures[1].values[0] == 9 * 257);
}

TEST_CASE("a file whose name differs only in capitals is found with a warning that names it") {
    const Folder folder;
    folder.write("Case.MTL", "newmtl a\nmap_Kd tex/WALL.png\nnewmtl b\nmap_Kd tex/wall.png\n");
    folder.write("Tex/Wall.PNG", grey({7}));
    if (fs::exists(folder / "tex")) {
        SKIP_CHECK("this file system ignores the case of names");
        return;
    }
    const Reading reading = read(folder, model("mtllib case.mtl", "ab"));
    REQUIRE(reading.file.textures.size() == 1);
    CHECK(reading.file.textures[0].values[0] == 7 * 257);
    CHECK_ERROR(reading.warnings, "\"case.mtl\" does not exist, using " + folder / "Case.MTL instead",
                "\"tex/WALL.png\" does not exist, using " + folder / "Tex/Wall.PNG instead");
    CHECK(lines_of(reading.warnings) == 2);
    folder.write("case.mtl", "newmtl a\nnewmtl b\n");
    CHECK(read(folder, model("mtllib case.mtl", "ab")).warnings == ""); // the exact name takes precedence
}

// ---- unsupported features

TEST_CASE("unsupported material properties are reported once per type with names") {
    const Folder folder;
    std::string mtl;
    for (const char* name : {"a", "b", "c", "d"})
        mtl += std::string("newmtl ") + name +
               "\nmap_Bump x.png\nbump x.png\nPr 0.5\nPc 0\nKs .5 .5 .5\nillum 2\n";
    const std::string warnings =
        read_mtl(folder, mtl + "map_Ks x.png\ndisp y.png\nrefl z.png\nmap_Ke k.png\n").warnings;
    CHECK_ERROR(warnings, "bump and normal maps are not supported (4 materials: \"a\", \"b\", \"c\", ...)",
                "roughness, sheen, coat and anisotropy (Pr, Ps, Pc, aniso) are not supported (4 materials",
                "maps of highlights, roughness and metal are not supported (material \"d\")",
                "displacement maps are not supported", "reflection maps are not supported", "map_Ke");
    CHECK(lines_of(warnings) == 6);
    CHECK(read_mtl(folder, "newmtl a\nKa 1 1 1\nNs 30\nTf 1 1 1\nKs 1 1 1\nillum 2\nPr 0\nd 1\n").warnings ==
          "");
}

TEST_CASE("d below 1 without refraction is drawn opaque with a warning for the materials that are used") {
    const Folder folder;
    const Reading reading = read_mtl(folder, "newmtl a\nd .5\nnewmtl b\nTr .1\nnewmtl c\nd 0\n", "ab");
    CHECK_ERROR(reading.warnings, "drawn opaque (2 materials: \"a\", \"b\")");
    CHECK(lines_of(reading.warnings) == 1);
}

TEST_CASE("lines that can be skipped are skipped with one warning that counts them") {
    const Folder folder;
    const auto warnings = [&](const std::string& mtl) {
        const Reading reading = read_mtl(folder, mtl);
        CHECK(reading.file.textures.empty());
        CHECK(lines_of(reading.warnings) == 1);
        return reading.warnings;
    };
    CHECK_ERROR(warnings("newmtl a\nmap_Kd\nmap_Kd -bm 1\nmap_d \n"), "m.mtl:2: \"map_Kd\" names no file",
                "3 such");
    CHECK_ERROR(warnings("map_Kd x.png\nKd nan 1 1\nnewmtl a\n"), "m.mtl:1: \"map_Kd\" is skipped",
                "no newmtl", "2 such");
    CHECK_ERROR(warnings("newmtl a\n\nfoo 1\nbar\n"), "m.mtl:3: \"foo\" is not a known statement", "2 such");
    CHECK_ERROR(warnings("newmtl a\nKs nan 0 0\nKs 1 1\n"),
                "Ks that is not three numbers is skipped (material \"a\")");
    CHECK_ERROR(warnings("newmtl a\nKd spectral steel.rfl 1\n"),
                "Kd as a spectrum is not supported (material \"a\")");
}

TEST_CASE("a colour in CIE XYZ becomes linear RGB") {
    const Folder folder;
    const Reading reading = read_mtl(
        folder, "newmtl a\nKd xyz .4124 .2126 .0193\nnewmtl b\nKd xyz .47525 .5 .5445\nnewmtl c\nKd xyz .3\n",
        "abc");
    CHECK(reading.warnings == "");
    CHECK(reading.file.materials[0].diffuse == approx(vec3(1, 0, 0), 1e-3f)); // the red primary of sRGB
    CHECK(reading.file.materials[2].diffuse == approx(vec3(0.3614f, 0.2845f, 0.2729f), 1e-3f));
    CHECK(reading.file.materials[1].diffuse == approx(vec3(0.5f), 1e-3f)); // its white point, halved
    CHECK_ERROR(error_of([&] { read_mtl(folder, "newmtl a\nKd xyz .3 .3\n"); }), "m.mtl:2:", "three numbers");
}

// ---- memory and time

TEST_CASE("a texture that is too large for its model becomes a checkerboard and its file is not decoded") {
    const Folder folder;
    folder.write("vast.png", packed_png(11'585, 11'585, 1, 0, zeros(70'000)));
    const Reading reading = read_mtl(folder, "newmtl a\nmap_Kd vast.png\n");
    CHECK_ERROR(reading.warnings, "vast.png", "11585 x 11585", "all textures of a model");
    CHECK(reading.file.textures[0].width == 8);
}

TEST_CASE(
    "thousands of materials and of library lines with different spellings of one file take little time") {
    const Folder folder;
    std::string mtl, obj, name = "big.mtl";
    for (int i = 0; i < 20'000; ++i) mtl += "newmtl m" + std::to_string(i) + "\n";
    folder.write("big.mtl", mtl);
    for (int i = 0; i < 3'000; ++i) obj += "mtllib " + std::string("x") + std::to_string(i) + "/../big.mtl\n";
    obj += "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    for (int i = 0; i < 20'000; ++i) obj += "usemtl m" + std::to_string(i) + "\nf 1 2 3\n";
    const std::clock_t begin = std::clock();
    CHECK(read(folder, obj).file.materials.size() == 20'000);
    const double seconds = double(std::clock() - begin) / CLOCKS_PER_SEC;
    CHECK_MESSAGE(
        seconds < 5,
        ("it took " + to_text(seconds) + " s of processor time")); // usually .2 s; minutes if quadratic
}
