// Facts about a model's files in a scene: its materials, its textures, and the fallback for a missing one.
#include "common/image/image.h"
#include "common/util/paths.h"
#include "common/math/random.h"
#include "tests/06_textures/scenes.h"
#include "tests/check.h"

#include <chrono>
#include <filesystem>
#include <fstream>

using namespace rt;

namespace {

/// A temporary folder that is deleted with its contents.
class Folder {
  public:
    Folder() {
        Random random{std::uint64_t(std::chrono::steady_clock::now().time_since_epoch().count())};
        path = std::filesystem::temp_directory_path() / ("raysteps_06_" + std::to_string(random.bits()));
        std::filesystem::create_directory(path);
    }
    ~Folder() { std::filesystem::remove_all(path); }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;

    std::string file(const std::string& name) const { return text_of(path / name); }
    void write(const std::string& name, const std::string& text) const { std::ofstream(path / name) << text; }
    /// Writes an image of one colour and returns that colour as quantised to 8 bits.
    vec3 write_picture(const std::string& name, vec3 linear) const {
        Image image(2, 3);
        for (vec3& pixel : image.pixels) pixel = linear;
        write_image(file(name), image);
        return read_image(file(name))(0, 0);
    }

  private:
    std::filesystem::path path;
};

} // namespace

TEST_CASE("one mesh can have several materials and several textures") {
    const Folder folder;
    const vec3 wood = folder.write_picture("wood.png", {0.5f, 0.3f, 0.1f});
    const vec3 stone = folder.write_picture("stone.png", {0.2f, 0.25f, 0.6f});
    folder.write("model.mtl",
                 "newmtl wood\nKd 1 1 1\nmap_Kd wood.png\n"
                 "newmtl plain\nKd 0.8 0.4 0.2\n"
                 "newmtl stone\nKd 0.5 1 0.25\nmap_Kd stone.png\n"
                 "newmtl wood again\nmap_Kd wood.png\n"
                 "newmtl lamp\nKd 0 0 0\nKe 3 2 1\n"
                 "newmtl wet stone\nKd 0.5 1 0.25\nmap_Kd stone.png\nillum 3\nKs 0.25 0.25 0.25\n");
    std::string obj = "mtllib model.mtl\nvt 0 0\nvt 1 0\nvt 0 1\n";
    const char* names[] = {"wood", "plain", "stone", "wood again", "lamp", "wet stone"};
    for (int i = 0; i < 6; ++i) {
        const std::string x = std::to_string(2 * i), right = std::to_string(2 * i + 1);
        obj += "v " + x + " 0 0\nv " + right + " 0 0\nv " + x + " 1 0\nusemtl " + names[i] +
               "\nf -3/1 -2/2 -1/3\n";
    }
    folder.write("model.obj", obj);

    Scene scene = evenly_lit();
    add(scene.textures, card()); // the scene is not empty before the model is added
    add(scene.materials, Diffuse{vec3(0.01f)});
    add_model(scene, read_obj(folder.file("model.obj")), 40);
    build_bvhs(scene);
    CHECK_MESSAGE(scene.textures.size() == 3, "each image file must be loaded once");
    const auto seen = [&](int i) { return seen_at(scene, float(2 * i) + 0.3f, 0.3f); };
    CHECK(seen(0) == approx(wood, 1e-4f));
    CHECK(seen(1) == approx({0.8f, 0.4f, 0.2f}, 1e-4f));
    CHECK_MESSAGE(seen(2) == approx(vec3(0.5f, 1, 0.25f) * stone, 1e-4f), "Kd multiplies the texture");
    CHECK_MESSAGE(seen(3) == approx(wood, 1e-4f), "a texture without Kd is shown unchanged");
    CHECK(seen(4) == approx({3, 2, 1}, 1e-4f));
    CHECK(seen(5) == approx(0.75f * vec3(0.5f, 1, 0.25f) * stone + 0.25f, 1e-4f));
}

TEST_CASE("two models keep their own textures") {
    const Folder folder;
    Scene scene = evenly_lit();
    std::vector<vec3> colours;
    for (int i = 0; i < 3; ++i) {
        const std::string name = "part" + std::to_string(i), x = std::to_string(2 * i);
        colours.push_back(
            folder.write_picture(name + ".png", vec3(0.2f * float(i + 1), 0.5f, 0.9f - 0.3f * float(i))));
        folder.write(name + ".mtl", "newmtl a\nmap_Kd " + name + ".png\n");
        folder.write(name + ".obj", "mtllib " + name + ".mtl\nusemtl a\nv " + x + " 0 0\nv " +
                                        std::to_string(2 * i + 1) + " 0 0\nv " + x + " 1 0\nf 1 2 3\n");
        add_model(scene, read_obj(folder.file(name + ".obj")), 40);
    }
    build_bvhs(scene);
    for (int i = 0; i < 3; ++i) {
        INFO("model ", i);
        CHECK_MESSAGE(seen_at(scene, float(2 * i) + 0.3f, 0.3f) == approx(colours[std::size_t(i)], 1e-4f),
                      "the indices of a model's textures start after those of the previous model");
    }
}

TEST_CASE("a missing texture is shown as a magenta checkerboard") {
    const Folder folder;
    folder.write("model.mtl", "newmtl a\nmap_Kd nowhere.png\n");
    folder.write("model.obj", "mtllib model.mtl\nusemtl a\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
                              "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n");
    Scene scene = evenly_lit();
    add_model(scene, read_obj(folder.file("model.obj")), 40); // prints a warning to stderr
    build_bvhs(scene);
    int magenta = 0, black = 0;
    for (int i = 0; i < 900; ++i) {
        const vec3 colour = seen_at(scene, (float(i % 30) + 0.5f) / 30, (float(i / 30) + 0.5f) / 30);
        if (!(colour.y == approx(0, 1e-4f) && colour.x == approx(colour.z, 1e-4f)))
            FAIL_CHECK("got ", colour, ", which is not a shade of magenta");
        magenta += colour.x > 0.5f;
        black += colour.x < 0.5f;
    }
    INFO("magenta ", magenta, ", black ", black, " of 900 points");
    CHECK_MESSAGE(magenta > 300, "a missing file must not go unnoticed");
    CHECK(black > 300);
}

TEST_CASE("an image from a file is upright on a mesh") {
    const Folder folder;
    Image image(3, 2);
    image.pixels = {red, green, blue, grey, cyan, orange};
    write_image(folder.file("card.png"), image);
    folder.write("model.mtl", "newmtl a\nmap_Kd card.png\n");
    folder.write("model.obj", "mtllib model.mtl\nusemtl a\nv 0 0 0\nv 3 0 0\nv 3 2 0\nv 0 2 0\n"
                              "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n");
    Scene scene = evenly_lit();
    add_model(scene, read_obj(folder.file("model.obj")), 40);
    build_bvhs(scene);
    CHECK_MESSAGE(seen_at(scene, 0.5f, 1.5f) == approx(red, 6e-3f), "grey: upside down; blue: mirrored");
    CHECK(seen_at(scene, 2.5f, 1.5f) == approx(blue, 6e-3f));
    CHECK(seen_at(scene, 0.5f, 0.5f) == approx(grey, 6e-3f));
    CHECK(seen_at(scene, 2.5f, 0.5f) == approx(orange, 6e-3f));
}

TEST_CASE("a glass model stays glass and a tree changes nothing about textured shapes") {
    Scene scene = evenly_lit();
    const auto material = [&](const ObjMaterial& m) {
        return scene.materials[std::size_t(add_material(scene, m, 0))];
    };
    CHECK(std::get<Dielectric>(material({.ior = 1.33f, .glass = true})).interior.ior == 1.33f);
    CHECK(std::get<Diffuse>(material({.diffuse = {0.8f, 0.4f, 0.2f}, .emission = {1, 2, 3}})).emission ==
          vec3(1, 2, 3));
    const ImageTexture lamp = std::get<ImageTexture>(
        material({.diffuse = {0.8f, 0.4f, 0.2f}, .emission = {1, 2, 3}, .texture = 4}));
    CHECK(lamp.texture == 4);
    CHECK(lamp.tint == vec3(0.8f, 0.4f, 0.2f));
    CHECK(lamp.emission == vec3(1, 2, 3));
    CHECK(lamp.uv_scale == vec2(1));

    const int picture = add(scene.materials, ImageTexture{add(scene.textures, card())});
    Random random(74);
    for (int i = 0; i < 60; ++i) {
        const vec2 p = random.get_2d();
        scene.spheres.push_back({{p.x, p.y, random.get_1d()}, 0.1f, picture});
    }
    for (const Accel accel : {Accel::bvh, Accel::wide}) {
        scene.accel = accel;
        build_bvhs(scene);
    }
    for (int i = 0; i < 500; ++i) {
        const vec2 p = random.get_2d();
        const Ray ray{{p.x, p.y, 4}, {0.01f, -0.02f, -1}};
        scene.accel = i % 2 ? Accel::bvh : Accel::wide;
        const vec3 tree = radiance(scene, ray, 2);
        const bool tree_shadow = occluded(scene, ray);
        scene.accel = Accel::brute;
        if (!(radiance(scene, ray, 2) == approx(tree))) FAIL_CHECK("ray ", i, " differs");
        CHECK(occluded(scene, ray) == tree_shadow);
    }
}
