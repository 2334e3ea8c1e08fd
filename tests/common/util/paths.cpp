// Facts about the search for assets.
#include "common/util/paths.h"

#include "common/util/error.h"
#include "common/util/system.h"

#include <doctest/doctest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>

namespace {

namespace fs = std::filesystem;

/// A folder of assets that RAYSTEPS_ASSETS names during its lifetime.
class ChosenFolder {
  public:
    ChosenFolder()
        : path(fs::temp_directory_path() / ("raysteps_assets_" + std::to_string(std::random_device{}()))) {
        fs::create_directories(path / "a_folder.obj");
        std::ofstream(path / "mine.obj") << "v 0 0 0\n";
        if (const char* const before = std::getenv("RAYSTEPS_ASSETS")) old = before;
        rt::set_environment("RAYSTEPS_ASSETS", rt::text_of(path));
    }
    ~ChosenFolder() {
        rt::set_environment("RAYSTEPS_ASSETS", old);
        std::error_code ignored;
        fs::remove_all(path, ignored);
    }
    ChosenFolder(const ChosenFolder&) = delete;
    ChosenFolder& operator=(const ChosenFolder&) = delete;

    const fs::path path;

  private:
    std::string old;
};

} // namespace

TEST_CASE("an asset is found in the folder that RAYSTEPS_ASSETS names") {
    const ChosenFolder folder;
    CHECK(rt::asset_path("mine.obj") == rt::text_of(folder.path / "mine.obj"));
}

TEST_CASE("a missing asset is an error that names every path tried") {
    const ChosenFolder folder;
    for (const std::string name : {"no_such_asset.obj", "a_folder.obj"}) {
        CAPTURE(name);
        std::string message;
        try {
            rt::asset_path(name);
        } catch (const rt::Error& error) {
            message = error.what();
        }
        CHECK(message.find("tried " + rt::text_of(folder.path / name) + ", ") != std::string::npos);
        CHECK(message.find("assets/" + name) != std::string::npos);
        CHECK(message.find("RAYSTEPS_ASSETS") != std::string::npos);
    }
}
