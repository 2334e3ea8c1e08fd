// Where the project's own assets stand, wherever a program is started from.
#pragma once

#include <string>

namespace rt {

/// The path of "cow.obj" and the like: looked up in the folder that the environment variable RAYSTEPS_ASSETS
/// names, then among the committed assets, then among those that the build makes. Throws Error with the
/// paths tried.
std::string asset_path(const std::string& name);

} // namespace rt
