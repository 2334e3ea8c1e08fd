// The materials of an OBJ file, as people really write them: names with spaces, backslashes, paths of
// somebody else's disk, files that were never copied along.
#include "common/obj/material.h"

#include "common/complain.h"
#include "common/error.h"
#include "common/file_bytes.h"
#include "common/obj/scan.h"

#include <algorithm>
#include <sstream>

namespace rt {
namespace {

namespace fs = std::filesystem;

std::string with_spaces(std::string name) {
    std::replace(name.begin(), name.end(), inner_space, ' ');
    return name;
}

/// Where a file that is called `name` may stand: as stated, seen from each folder, and by its bare name
/// there.
std::vector<fs::path> candidates(const std::string& name, const std::vector<fs::path>& folders) {
    std::vector<fs::path> paths;
    const auto add = [&](const fs::path& path) {
        const fs::path normal = path.lexically_normal();
        if (std::find(paths.begin(), paths.end(), normal) == paths.end()) paths.push_back(normal);
    };
    for (const fs::path& folder : folders) add(folder / name); // an absolute name stays as it is
    for (const fs::path& folder : folders) add(folder / fs::path(name).filename());
    return paths;
}

std::string listed(const std::vector<fs::path>& paths) {
    std::string text;
    for (const fs::path& path : paths) text += (text.empty() ? "" : ", ") + path.string();
    return text;
}

bool is_there(const fs::path& path) {
    std::error_code ignored;
    return fs::is_regular_file(path, ignored);
}

std::vector<std::string> split(const std::string& text, char separator) {
    std::vector<std::string> parts;
    std::istringstream stream(text);
    for (std::string part; std::getline(stream, part, separator);) {
        if (!part.empty()) parts.push_back(part);
    }
    return parts;
}

/// Eight by eight, magenta and black: a colour that nobody mistakes for the model's own.
Bitmap checker() {
    Bitmap bitmap{8, 8, {}};
    for (int i = 0; i < 64; ++i) {
        const std::uint16_t bright = (i + i / 8) % 2 == 0 ? 65535 : 0;
        bitmap.values.insert(bitmap.values.end(), {bright, std::uint16_t(0), bright});
    }
    return bitmap;
}

float clamped(float value, float low, float high, const std::string& where, const char* what) {
    if (value >= low && value <= high) return value;
    const float kept = value < low ? low : high;
    std::ostringstream message;
    message << where << ": " << what << " is " << value << " and is taken as " << kept;
    warn(message.str());
    return kept;
}

vec3 clamped(const float (&value)[3], float high, const std::string& where, const char* what) {
    vec3 kept(0.0f);
    for (int i = 0; i < 3; ++i) kept[i] = clamped(value[i], 0, high, where, what);
    return kept;
}

bool asks_for_reflection(int illum) {
    return illum == 3 || illum == 5 || illum == 8;
}

bool asks_for_refraction(int illum) {
    return illum == 4 || illum == 6 || illum == 7 || illum == 9;
}

vec3 diffuse_of(const tinyobj::material_t& source, const std::string& where) {
    if (source.diffuse[0] != unstated) return clamped(source.diffuse, 1, where, "Kd");
    if (!source.diffuse_texname.empty()) return vec3(1.0f); // the texture alone is the colour
    const bool shines = source.emission[0] > 0 || source.emission[1] > 0 || source.emission[2] > 0;
    return shines ? vec3(0.0f) : ObjMaterial{}.diffuse;
}

float reflectivity_of(const tinyobj::material_t& source, const std::string& where) {
    const float metal = clamped(source.metallic, 0, 1, where, "Pm");
    if (!asks_for_reflection(source.illum)) return metal;
    const vec3 specular = clamped(source.specular, 1, where, "Ks");
    return std::max(metal, (specular.x + specular.y + specular.z) / 3);
}

} // namespace

void warn(const std::string& message) {
    print_error_line("warning: " + message);
}

bool MaterialLibraries::operator()(const std::string& names, std::vector<tinyobj::material_t>* materials,
                                   std::map<std::string, int>* numbers, std::string* warnings,
                                   std::string* errors) {
    const std::vector<fs::path> folders{fs::path(obj_path).parent_path()};
    const auto find = [&](const std::string& name) {
        const std::vector<fs::path> paths = candidates(name, folders);
        return *std::find_if(paths.begin(), paths.end() - 1, is_there);
    };
    std::vector<std::string> list{with_spaces(names)};
    if (!is_there(find(list[0])) && names.find(inner_space) != std::string::npos)
        list = split(names, inner_space);
    for (const std::string& name : list) {
        const fs::path file = find(name);
        if (!is_there(file)) {
            warn(obj_path + ": material file " + in_quotes(name) +
                 " not found, its materials are grey; tried " + listed(candidates(name, folders)));
            continue;
        }
        std::istringstream stream(scan_mtl(file.string(), read_file(file.string())));
        tinyobj::LoadMtl(numbers, materials, &stream, warnings, errors);
        files.resize(materials->size(), file);
    }
    return true; // tinyobjloader need not look for it once more
}

int TextureLoader::find_or_read(const std::string& file) {
    const auto [place, is_new] = known.emplace(fs::weakly_canonical(file).string(), int(bitmaps.size()));
    if (!is_new) return place->second;
    try {
        bitmaps.push_back(read_bitmap(file));
    } catch (...) {
        known.erase(place);
        throw;
    }
    return place->second;
}

int TextureLoader::load(const fs::path& mtl, const std::string& name) {
    const auto missing = known.find("missing " + name);
    if (missing != known.end()) return missing->second;
    const std::vector<fs::path> paths = candidates(name, {mtl.parent_path(), obj_path.parent_path()});
    std::string reason = "no such file";
    for (const fs::path& path : paths) {
        if (!is_there(path)) continue;
        try {
            return find_or_read(path.string());
        } catch (const Error& error) {
            reason = error.what();
        }
    }
    warn(mtl.string() + ": texture " + in_quotes(name) +
         " cannot be used, a magenta checker takes its place; tried " + listed(paths) + " (" + reason + ")");
    bitmaps.push_back(checker());
    return known["missing " + name] = int(bitmaps.size()) - 1;
}

ObjMaterial converted(const tinyobj::material_t& source, const fs::path& mtl, TextureLoader& textures) {
    ObjMaterial material;
    material.name = with_spaces(source.name);
    const std::string where = mtl.string() + ": material " + in_quotes(material.name);
    material.diffuse = diffuse_of(source, where);
    material.emission = clamped(source.emission, infinity, where, "Ke");
    material.reflectivity = reflectivity_of(source, where);
    material.ior = clamped(source.ior, 1, 4, where, "Ni");
    material.glass = asks_for_refraction(source.illum) || (source.dissolve < 1 && material.ior > 1);
    if (!source.diffuse_texname.empty()) material.texture = textures.load(mtl, source.diffuse_texname);
    return material;
}

} // namespace rt
