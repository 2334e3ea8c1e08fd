// The materials of an OBJ file: finds its .mtl files and their textures, checks them, and says what is
// missing.
#pragma once

#include "common/obj_file.h"

#include <tiny_obj_loader.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace rt {

/// One line on stderr.
void warn(const std::string& message);

/// What tinyobjloader calls at each mtllib line. Missing libraries are warnings, wrong numbers an Error.
class MaterialLibraries : public tinyobj::MaterialReader {
  public:
    explicit MaterialLibraries(const std::string& obj_path_) : obj_path(obj_path_) {}

    /// `names`: the rest of the mtllib line, with `inner_space` for spaces: one name with spaces, or several.
    bool operator()(const std::string& names, std::vector<tinyobj::material_t>* materials,
                    std::map<std::string, int>* numbers, std::string* warnings, std::string* errors) override;

    /// The file that material `number` of the vector stands in.
    const std::filesystem::path& file_of(std::size_t number) const { return files[number]; }
    bool found_any() const { return !files.empty(); }

  private:
    std::string obj_path;
    std::vector<std::filesystem::path> files; ///< one a material
};

/// Loads each texture once.
class TextureLoader {
  public:
    explicit TextureLoader(const std::string& obj_path_) : obj_path(obj_path_) {}

    /// The number in `bitmaps` of the texture that `mtl` calls `name`. One that cannot be read becomes a
    /// magenta checker, with a warning that says which paths were tried.
    int load(const std::filesystem::path& mtl, const std::string& name);

    std::vector<Bitmap> bitmaps;

  private:
    int find_or_read(const std::string& file);

    std::filesystem::path obj_path;
    std::map<std::string, int> known; ///< by file, or by name for those that are missing
};

/// The text of an .mtl file reduced to what we use, each number checked; unstated Kd as `unstated`.
std::string scan_mtl(const std::string& path, std::string text);
inline constexpr float unstated = -1;

/// `source` in our terms; numbers out of range are clamped, with a warning.
ObjMaterial converted(const tinyobj::material_t& source, const std::filesystem::path& mtl,
                      TextureLoader& textures);

} // namespace rt
