// The materials of an OBJ file: finds its .mtl files and their textures, checks them, and says what is
// missing.
#pragma once

#include "common/model/obj/unfollowed.h"
#include "common/model/obj_file.h"

#include <tiny_obj_loader.h>

#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace rt {

/// One line on stderr.
void warn(const std::string& message);

/// What tinyobjloader calls at each mtllib line. Missing libraries are warnings, wrong numbers an Error.
class MaterialLibraries : public tinyobj::MaterialReader {
  public:
    explicit MaterialLibraries(const std::string& obj_path_) : obj_path(obj_path_) {}

    /// `names`: the rest of the mtllib line, with `name_space` for spaces: one name with spaces, or
    /// several. A file is read once, however often and by whatever names it is called.
    bool operator()(const std::string& names, std::vector<tinyobj::material_t>* materials,
                    std::map<std::string, int>* numbers, std::string* warnings, std::string* errors) override;

    /// The file that material `number` of the vector stands in.
    const std::filesystem::path& file_of(std::size_t number) const { return files[number]; }
    bool found_any() const { return !files.empty(); }

  private:
    std::vector<std::filesystem::path> find(const std::string& names) const;

    std::string obj_path;
    std::vector<std::filesystem::path> files; ///< one a material
    std::set<std::string> known;              ///< the files so far, each by its canonical path
};

/// Loads each texture and mask once, and no more of them than `max_texture_pixels`.
class TextureLoader {
  public:
    explicit TextureLoader(const std::string& obj_path_) : obj_path(obj_path_) {}

    /// The number in `bitmaps` of the texture that `mtl` calls `name`. One that cannot be read becomes a
    /// magenta checker, with a warning that says which paths were tried.
    int load(const std::filesystem::path& mtl, const std::string& name);

    /// The number in `masks` of what that picture says as a mask; -1 if it has no hole, or, with a warning,
    /// cannot be read.
    int load_mask(const std::filesystem::path& mtl, const std::string& name);

    /// The number in `masks` of the holes in a texture that is loaded, -1 if it has none.
    int mask_of_texture(int texture);

    std::vector<Bitmap> bitmaps;
    std::vector<Mask> masks;
    Unfollowed unfollowed; ///< by the materials that are converted

  private:
    using Known = std::map<std::string, int>; ///< by canonical path, or by name for those that are missing
    using Read = std::function<int(const std::string& file)>;

    int find_or_read(Known& known, const std::filesystem::path& mtl, const std::string& name,
                     const Read& read, const std::string& instead, const std::function<int()>& substitute);
    Bitmap read_picture(const std::string& file);
    int add_texture(Bitmap bitmap);
    int add_mask(const Bitmap& bitmap);

    std::filesystem::path obj_path;
    std::int64_t pixels_left = max_texture_pixels;
    Known known_textures, known_masks;
    std::map<int, int> texture_masks; ///< from numbers in `bitmaps` to numbers in `masks`
};

/// The text of an .mtl file reduced to what we use, each number checked; unset Kd as `unset`. Warns
/// of what it asks for and is not followed.
std::string scan_mtl(const std::string& path, std::string text);
inline constexpr float unset = -1;

/// `source` in our terms; numbers out of range are clamped, with a warning.
ObjMaterial convert_material(const tinyobj::material_t& source, const std::filesystem::path& mtl,
                             TextureLoader& textures);

} // namespace rt
