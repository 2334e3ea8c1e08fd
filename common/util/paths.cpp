// Finds assets in the folders where they may be.

#include "common/util/paths.h"

#include "common/util/error.h"

#include <array>
#include <cstdlib>
#include <filesystem>

#ifndef RT_SOURCE_ASSETS // CMake sets both to absolute paths
#define RT_SOURCE_ASSETS "assets"
#endif
#ifndef RT_BUILD_ASSETS
#define RT_BUILD_ASSETS "build/assets"
#endif

namespace rt {

std::string asset_path(const std::string& name) {
    const char* const chosen = std::getenv("RAYSTEPS_ASSETS");
    const std::array<std::string, 3> folders{chosen ? chosen : "", RT_SOURCE_ASSETS, RT_BUILD_ASSETS};
    std::string tried;
    for (const std::string& folder : folders) {
        if (folder.empty()) continue;
        const std::string path = text_of(path_of(folder) / path_of(name));
        std::error_code ignored;
        if (std::filesystem::is_regular_file(path_of(path), ignored)) return path;
        tried += (tried.empty() ? "" : ", ") + path;
    }
    throw Error("the asset " + name + " is missing, tried " + tried +
                ": build the project, or set RAYSTEPS_ASSETS to the folder that holds it");
}

} // namespace rt
