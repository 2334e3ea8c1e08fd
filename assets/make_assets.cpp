// Makes every model and texture that the scenes use; each run writes the same bytes.
#include "assets/cat.h"
#include "assets/cow.h"
#include "assets/globe.h"
#include "assets/obj_writer.h"
#include "assets/teapot.h"
#include "assets/test_card.h"
#include "common/util/report_error.h"
#include "common/util/version.h"
#include "common/util/paths.h"

#include <CLI/CLI.hpp>

#include <filesystem>

namespace rt::assets {
namespace {

namespace fs = std::filesystem;

fs::path with_ending(fs::path path, const char* ending) {
    return path.replace_extension(ending);
}

void make_teapot(const fs::path& obj, int density) {
    ObjWriter writer(text_of(obj));
    for (const Patch& patch : teapot_patches()) writer.add(tessellate(patch, density));
    writer.finish();
    write_mtl(text_of(with_ending(obj, ".mtl")), "");
}

void make_animal(const Animal& animal, const fs::path& obj, int triangles) {
    Mesh mesh = polygonise(animal.shape, animal.bounds, triangles);
    constexpr int texture_size = 1024;
    unwrap(mesh, texture_size);
    ObjWriter writer(text_of(obj));
    writer.add(mesh);
    writer.finish();
    const fs::path texture = with_ending(obj, ".png");
    write_png(text_of(texture), bake(mesh, texture_size, animal.ground, animal.hide));
    write_mtl(text_of(with_ending(obj, ".mtl")), text_of(texture.filename()));
}

void make_all(const fs::path& folder) {
    make_teapot(folder / "teapot.obj", 6);
    make_animal(cow::animal, folder / "cow.obj", 6000);
    make_animal(cat::animal, folder / "cat.obj", 6000);
    write_png(text_of(folder / "test_card.png"), test_card());
    write_png(text_of(folder / "globe.png"), globe());
}

int run(int argc, char** argv) {
    CLI::App app("Makes the models and textures of the Raysteps scenes.");
    app.allow_windows_style_options(false); // a path may begin with a slash
    app.require_subcommand(1);
    app.set_version_flag("--version", version());
    std::string out;
    int density = 6, triangles = 6000;

    CLI::App& all = *app.add_subcommand("all", "Makes the small set that is committed to the repository.");
    all.add_option("--out", out, "Folder to write to")->required()->check(CLI::ExistingDirectory);

    CLI::App& teapot = *app.add_subcommand("teapot", "Makes the Utah teapot at any density.");
    teapot.add_option("--density", density, "Quads along each side of the 32 patches")
        ->check(CLI::Range(2, 2000));
    teapot.add_option("--out", out, "The .obj file to write")->required();

    const auto add_animal = [&](const Animal& animal) -> CLI::App& {
        CLI::App& command =
            *app.add_subcommand(animal.name, "Makes the " + animal.name + " with its texture.");
        command.add_option("--triangles", triangles, "Approximate number of triangles")
            ->check(CLI::Range(2000, 1000000));
        command.add_option("--out", out, "The .obj file to write; its .mtl and .png go beside it")
            ->required();
        return command;
    };
    const CLI::App& cow = add_animal(cow::animal);
    const CLI::App& cat = add_animal(cat::animal);

    try {
        app.parse(argc, argv);
        if (all) make_all(path_of(out));
        if (teapot) make_teapot(path_of(out), density);
        if (cow) make_animal(cow::animal, path_of(out), triangles);
        if (cat) make_animal(cat::animal, path_of(out), triangles);
    } catch (const CLI::Success& help) {
        return app.exit(help);
    } catch (const std::exception& problem) {
        return report_error("make_assets", problem.what());
    }
    return 0;
}

} // namespace
} // namespace rt::assets

int main(int argc, char** argv) {
    return rt::assets::run(argc, argv);
}
