// Facts about the search for assets.
#include "common/util/paths.h"

#include "common/util/error.h"

#include <doctest/doctest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>

#if !defined(_WIN32)

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
        setenv("RAYSTEPS_ASSETS", path.c_str(), 1);
    }
    ~ChosenFolder() {
        if (old.empty())
            unsetenv("RAYSTEPS_ASSETS");
        else
            setenv("RAYSTEPS_ASSETS", old.c_str(), 1);
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
    CHECK(rt::asset_path("mine.obj") == (folder.path / "mine.obj").string());
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
        CHECK(message.find("tried " + (folder.path / name).string() + ", ") != std::string::npos);
        CHECK(message.find("assets/" + name) != std::string::npos);
        CHECK(message.find("RAYSTEPS_ASSETS") != std::string::npos);
    }
}

#endif
