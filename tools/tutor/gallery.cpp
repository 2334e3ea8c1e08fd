// Finds its way in exercises/ and assets/reference/.
#include "tools/tutor/gallery.h"

#include "common/util/error.h"
#include "common/util/file_bytes.h"

#include <algorithm>
#include <cstdlib>
#include <sstream>

namespace rt {

namespace fs = std::filesystem;

fs::path gallery_picture(const fs::path& root, const std::string& step, const std::string& id) {
    return root / "exercises" / step / "gallery" / (id + ".png");
}

std::string reference_fact(const fs::path& root, const std::string& step, const std::string& key) {
    std::istringstream lines(read_file((root / "assets" / "reference" / (step + ".txt")).string()));
    for (std::string line; std::getline(lines, line);)
        if (line.starts_with(key + ": ")) return line.substr(key.size() + 2);
    return "";
}

std::vector<std::string> gallery_flags(const fs::path& root, const std::string& step) {
    const auto part = [&](const std::string& side) {
        return std::to_string(std::max(1, std::atoi(reference_fact(root, step, side).c_str()) * 3 / 8));
    };
    return {"--width", part("width"), "--height", part("height"), "--samples", "16"};
}

compare::CatalogueMatch nearest_mistake(const fs::path& root, const std::string& step,
                                        const fs::path& picture) {
    const fs::path right = gallery_picture(root, step, "right");
    std::error_code ignored;
    if (!fs::exists(right, ignored)) return {};
    std::vector<compare::CatalogueImage> wrong = compare::read_catalogue_images(right.parent_path().string());
    std::erase_if(wrong, [](const compare::CatalogueImage& known) { return known.name == "right"; });
    return compare::find_in_catalogue(compare::read_encoded(picture.string()),
                                      compare::read_encoded(right.string()), {}, wrong);
}

} // namespace rt
