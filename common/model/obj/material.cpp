// The materials of an OBJ file: finds their libraries and textures, and converts them to ObjMaterial.
#include "common/model/obj/material.h"

#include "common/util/report_error.h"
#include "common/util/error.h"
#include "common/util/file_bytes.h"
#include "common/model/obj/find_file.h"
#include "common/model/obj/mask.h"
#include "common/util/text.h"
#include "common/util/paths.h"

#include <algorithm>
#include <sstream>

namespace rt {
namespace {

namespace fs = std::filesystem;

std::string with_spaces(std::string name) {
    std::replace(name.begin(), name.end(), name_space, ' ');
    return name;
}

/// Warns if a file was found under a name that differs from those in `paths`.
void warn_of_case(const std::string& where, const std::string& name, const fs::path& file,
                  const std::vector<fs::path>& paths) {
    if (std::find(paths.begin(), paths.end(), file) == paths.end())
        warn(where + ": " + in_quotes(name) + " does not exist, using " + text_of(file) + " instead");
}

/// Returns an 8 x 8 checker of magenta and black, which nobody mistakes for the model's own texture.
Bitmap checker() {
    Bitmap bitmap{8, 8, {}, {}, ""};
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
    message << where << ": " << what << " is " << value << " and is clamped to " << kept;
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
    if (source.diffuse[0] != unset) return clamped(source.diffuse, 1, where, "Kd");
    if (!source.diffuse_texname.empty()) return vec3(1.0f); // the texture alone gives the colour
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

/// Returns the existing files of an mtllib line.
std::vector<fs::path> MaterialLibraries::find(const std::string& names) const {
    const std::vector<fs::path> folders{path_of(obj_path).parent_path()};
    const NamesOfLine line = names_of_line(names);
    std::vector<std::string> parts = line.parts;
    if (parts.size() > 1 && !existing(candidates(line.whole, folders)).empty()) parts = {line.whole};
    std::vector<fs::path> found;
    for (const std::string& name : parts) {
        const std::vector<fs::path> paths = candidates(name, folders);
        const std::vector<fs::path> there = existing(paths);
        if (there.empty()) {
            warn(obj_path + ": material file " + in_quotes(name) +
                 " not found, its materials are grey; tried " + listed(paths));
            continue;
        }
        warn_of_case(obj_path, name, there[0], paths);
        found.push_back(there[0]);
    }
    return found;
}

bool MaterialLibraries::operator()(const std::string& names, std::vector<tinyobj::material_t>* materials,
                                   std::map<std::string, int>* numbers, std::string* warnings,
                                   std::string* errors) {
    for (const fs::path& file : find(names)) {
        if (!known.insert(one_name_of(file)).second) continue;
        std::istringstream stream(scan_mtl(text_of(file), read_file(text_of(file))));
        tinyobj::LoadMtl(numbers, materials, &stream, warnings, errors);
        files.resize(materials->size(), file);
    }
    return true; // tinyobjloader need not search for it again
}

/// Returns the index of the image that `mtl` calls `name`: from `known`, or else by read(file). If no file
/// exists or none can be read, returns substitute() and warns; the warning contains `instead`.
int TextureLoader::find_or_read(Known& known, const fs::path& mtl, const std::string& name, const Read& read,
                                const std::string& instead, const std::function<int()>& substitute) {
    const std::string missing = "missing " + name;
    if (const auto place = known.find(missing); place != known.end()) return place->second;
    const std::vector<fs::path> paths = candidates(name, {mtl.parent_path(), obj_path.parent_path()});
    std::string reason = "no such file";
    for (const fs::path& path : existing(paths)) {
        const std::string key = one_name_of(path);
        if (const auto place = known.find(key); place != known.end()) return place->second;
        warn_of_case(text_of(mtl), name, path, paths);
        try {
            return known[key] = read(text_of(path));
        } catch (const Error& error) {
            reason = error.what();
        }
    }
    warn(text_of(mtl) + ": texture " + in_quotes(name) + " cannot be used, " + instead + "; tried " +
         listed(paths) + " (" + reason + ")");
    return known[missing] = substitute();
}

Bitmap TextureLoader::read_picture(const std::string& file) {
    Bitmap bitmap = read_bitmap(file, pixels_left);
    pixels_left -= std::int64_t(bitmap.width) * bitmap.height;
    if (!bitmap.flaw.empty()) warn(file + ": " + bitmap.flaw + " and is used as far as it can be read");
    return bitmap;
}

int TextureLoader::add_texture(Bitmap bitmap) {
    fill_hidden_colours(bitmap);
    bitmaps.push_back(std::move(bitmap));
    return int(bitmaps.size()) - 1;
}

int TextureLoader::add_mask(const Bitmap& bitmap) {
    Mask mask = mask_of(bitmap);
    if (mask.opacity.empty()) return -1;
    masks.push_back(std::move(mask));
    return int(masks.size()) - 1;
}

int TextureLoader::load(const fs::path& mtl, const std::string& name) {
    return find_or_read(
        known_textures, mtl, name, [&](const std::string& file) { return add_texture(read_picture(file)); },
        "a magenta checker replaces it", [&] { return add_texture(checker()); });
}

int TextureLoader::load_mask(const fs::path& mtl, const std::string& name) {
    return find_or_read(
        known_masks, mtl, name, [&](const std::string& file) { return add_mask(read_picture(file)); },
        "its material has no holes", [] { return -1; });
}

int TextureLoader::mask_of_texture(int texture) {
    if (texture < 0 || bitmaps[std::size_t(texture)].opacity.empty()) return -1;
    if (const auto place = texture_masks.find(texture); place != texture_masks.end()) return place->second;
    return texture_masks[texture] = add_mask(bitmaps[std::size_t(texture)]);
}

ObjMaterial convert_material(const tinyobj::material_t& source, const fs::path& mtl,
                             TextureLoader& textures) {
    ObjMaterial material;
    material.name = with_spaces(source.name);
    const std::string where = text_of(mtl) + ": material " + in_quotes(material.name);
    material.diffuse = diffuse_of(source, where);
    material.emission = clamped(source.emission, infinity, where, "Ke");
    material.reflectivity = reflectivity_of(source, where);
    material.ior = clamped(source.ior, 1, 4, where, "Ni");
    material.glass = asks_for_refraction(source.illum) || (source.dissolve < 1 && material.ior > 1);
    if (source.dissolve < 1 && !material.glass)
        textures.unfollowed.add(text_of(mtl), "d below 1 (or Tr above 0) without refraction is drawn opaque",
                                material.name);
    if (!source.diffuse_texname.empty()) material.texture = textures.load(mtl, source.diffuse_texname);
    if (!material.glass)
        material.mask = source.alpha_texname.empty() ? textures.mask_of_texture(material.texture)
                                                     : textures.load_mask(mtl, source.alpha_texname);
    return material;
}

} // namespace rt
