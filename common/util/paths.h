// The text of paths, which is UTF-8 on every system, and the project's assets.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace rt {

/// Returns the path that a text names. Its own constructor would read the text in the encoding of the system.
inline std::filesystem::path path_of(std::string_view text) {
    return std::filesystem::path(std::u8string(text.begin(), text.end()));
}

/// Returns the text of a path, with slashes on every system.
inline std::string text_of(const std::filesystem::path& path) {
    const std::u8string text = path.generic_u8string();
    return {text.begin(), text.end()};
}

/// Returns the path of an asset, as in "cow.obj". Searches the folder named by the environment
/// variable RAYSTEPS_ASSETS, then the committed assets, then the assets made by the build. Throws
/// Error with the paths tried.
std::string asset_path(const std::string& name);

} // namespace rt
