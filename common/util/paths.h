// Finds the project's assets, from any working directory.
#pragma once

#include <string>

namespace rt {

/// Returns the path of an asset, as in "cow.obj". Searches the folder named by the environment
/// variable RAYSTEPS_ASSETS, then the committed assets, then the assets made by the build. Throws
/// Error with the paths tried.
std::string asset_path(const std::string& name);

} // namespace rt
