// test_fuzz TARGET FOLDER...: feeds each file of the folders to a target.
// It needs no libFuzzer and finds nothing new.
#include "tests/fuzz/fuzz.h"
#include "common/util/paths.h"

#include <algorithm>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <vector>

namespace fs = std::filesystem;

namespace {

std::vector<fs::path> files_of(const fs::path& folder) {
    std::vector<fs::path> files;
    if (fs::exists(folder))
        for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
    std::ranges::sort(files);
    return files;
}

/// Returns whether the target keeps its promises.
bool replay(const rt::fuzz::Target& target, const fs::path& path) {
    std::cout << rt::text_of(path) << std::endl; // if the program crashes, the last line names the file
    std::ifstream stream(path, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
    try {
        target.run(bytes);
        return true;
    } catch (const std::exception& exception) {
        std::cout << "    " << exception.what() << std::endl;
        return false;
    }
}

} // namespace

int main(int count, char** words) {
    const rt::fuzz::Target* target = count > 2 ? rt::fuzz::find_target(words[1]) : nullptr;
    if (!target) {
        std::cerr << "usage: test_fuzz TARGET FOLDER...; the targets are those of tests/fuzz/fuzz.cpp\n";
        return 2;
    }
    std::cerr.setstate(std::ios::failbit); // warnings about damaged files
    int fed = 0, bad = 0;
    for (int i = 2; i < count; ++i)
        for (const fs::path& path : files_of(words[i])) {
            ++fed;
            bad += replay(*target, path) ? 0 : 1;
        }
    std::cout << target->name << ": " << fed << " files, " << bad << " break a promise\n";
    return fed > 0 && bad == 0 ? 0 : 1;
}
