// Looks into tests/ and at the exercises.
#include "tools/tutor/check_files.h"

#include "tools/tutor/exercises.h"

#include <algorithm>

namespace rt {

namespace fs = std::filesystem;

std::vector<std::string> check_files(const fs::path& root, const std::string& step) {
    std::vector<std::string> files;
    for (const fs::path& entry : entries_of(root / "tests" / step)) {
        const fs::path name = entry.filename();
        if (name.extension() == ".cpp") files.push_back(step + "_" + name.stem().string());
    }
    std::stable_partition(files.begin(), files.end(), [](const std::string& file) { return !is_slow(file); });
    auto place = files.begin();
    for (const Exercise& exercise : find_step_exercises(root / "steps", step)) {
        const auto own = std::find(place, files.end(), check_file_of(step, exercise.file));
        if (own != files.end()) std::rotate(place++, own, own + 1);
    }
    return files;
}

std::string check_source(const std::string& step, const std::string& file) {
    return "tests/" + step + file.substr(step.size()).replace(0, 1, "/") + ".cpp";
}

bool is_slow(const std::string& file) {
    return file.ends_with("_statistics");
}

std::string check_file_of(const std::string& step, const std::string& header) {
    return step + "_" + fs::path(header).stem().string();
}

} // namespace rt
