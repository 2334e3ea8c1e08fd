// The list of fuzz targets, and their input files.
#include "tests/fuzz/fuzz.h"
#include "common/util/paths.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <random>
#include <stdexcept>

namespace rt::fuzz {

namespace fs = std::filesystem;

namespace {

struct Folder {
    std::string path =
        text_of(fs::temp_directory_path() / ("raysteps_fuzz_" + std::to_string(std::random_device{}())));

    Folder() { fs::create_directories(path); }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    ~Folder() {
        std::error_code ignored;
        fs::remove_all(path, ignored);
    }
};

constexpr std::array all{
    Target{"bmp", run_picture},       Target{"catalogue", run_catalogue},
    Target{"hdr", run_hdr},           Target{"jpeg", run_picture},
    Target{"json", run_json},         Target{"mtl", run_mtl},
    Target{"numbers", run_numbers},   Target{"obj", run_obj},
    Target{"obj_text", run_obj_text}, Target{"options", run_options},
    Target{"png", run_picture},       Target{"sphere_list", run_sphere_list},
    Target{"tga", run_tga},           Target{"tutor", run_tutor},
    Target{"weave", run_weave},
};

} // namespace

void require(bool holds, const char* promise) {
    if (!holds) throw std::logic_error(std::string("broken: ") + promise);
}

const std::string& folder() {
    static const Folder folder;
    return folder.path;
}

std::string write_input(const std::string& name, std::string_view bytes) {
    const std::string path = folder() + "/" + name;
    std::ofstream(path, std::ios::binary).write(bytes.data(), std::streamsize(bytes.size()));
    return path;
}

Parts first_line(std::string_view text) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    return {std::string(text.substr(0, end)), std::string(text.substr(std::min(end + 1, text.size())))};
}

std::span<const Target> targets() {
    return all;
}

const Target* find_target(std::string_view name) {
    const auto found =
        std::ranges::find(all, name, [](const Target& target) { return std::string_view(target.name); });
    return found == all.end() ? nullptr : &*found;
}

} // namespace rt::fuzz
