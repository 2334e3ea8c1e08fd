// Collects unsupported features of material files and warns once per kind.
#include "common/model/obj/unfollowed.h"

#include "common/model/obj/material.h"
#include "common/util/text.h"

namespace rt {

void Unfollowed::add(const std::string& path, const std::string& what, const std::string& material) {
    Materials& materials = kinds[path + ": " + what];
    if (materials.count > 0 && materials.last == material) return;
    materials.last = material;
    ++materials.count;
    if (materials.names.size() < 3) materials.names.push_back(material);
}

void Unfollowed::tell() const {
    for (const auto& [sentence, materials] : kinds) {
        std::string text = sentence + " (";
        text += materials.count == 1 ? "material " : std::to_string(materials.count) + " materials: ";
        for (std::size_t i = 0; i < materials.names.size(); ++i)
            text += (i == 0 ? "" : ", ") + in_quotes(materials.names[i]);
        warn(text + (materials.count > 3 ? ", ...)" : ")"));
    }
}

} // namespace rt
