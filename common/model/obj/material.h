// The materials of an OBJ file: finds and checks its .mtl files and textures, and warns of what is missing.
#pragma once

#include "common/model/obj/unfollowed.h"
#include "common/model/obj_file.h"
#include "common/util/paths.h"

#include <tiny_obj_loader.h>

#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace rt {

/// Prints a warning as one line on stderr.
void warn(const std::string& message);

/// Reads the material libraries of an mtllib line. A missing library is a warning, an
/// invalid number an Error.
class MaterialLibraries : public tinyobj::MaterialReader {
  public:
    explicit MaterialLibraries(const std::string& obj_path_) : obj_path(obj_path_) {}

    /// Reads the libraries of one mtllib line. `names`: the rest of the line, with `name_space` for spaces;
    /// either one name with spaces, or several names. Each file is read once, however often and under
    /// whatever names it occurs.
    bool operator()(const std::string& names, std::vector<tinyobj::material_t>* materials,
                    std::map<std::string, int>* numbers, std::string* warnings, std::string* errors) override;

    /// Returns the file that defines material `number` of the vector.
    const std::filesystem::path& file_of(std::size_t number) const { return files[number]; }
    bool found_any() const { return !files.empty(); }

  private:
    std::vector<std::filesystem::path> find(const std::string& names) const;

    std::string obj_path;
    std::vector<std::filesystem::path> files; ///< one per material
    std::set<std::string> known;              ///< the files read so far, by canonical path
};

/// Loads each texture and mask once. All of them together have at most `max_texture_pixels` pixels.
class TextureLoader {
  public:
    explicit TextureLoader(const std::string& obj_path_) : obj_path(path_of(obj_path_)) {}

    /// Returns the index in `bitmaps` of the texture that `mtl` calls `name`. If it cannot be read, a magenta
    /// checker replaces it, and a warning lists the paths tried.
    int load(const std::filesystem::path& mtl, const std::string& name);

    /// Returns the index in `masks` of the mask in that image; -1 if it has no holes or, with a
    /// warning, cannot be read.
    int load_mask(const std::filesystem::path& mtl, const std::string& name);

    /// Returns the index in `masks` of the alpha mask of a loaded texture, or -1 if it has no holes.
    int mask_of_texture(int texture);

    std::vector<Bitmap> bitmaps;
    std::vector<Mask> masks;
    Unfollowed unfollowed; ///< features of converted materials that are not supported

  private:
    using Known = std::map<std::string, int>; ///< by canonical path, or by name if missing
    using Read = std::function<int(const std::string& file)>;

    int find_or_read(Known& known, const std::filesystem::path& mtl, const std::string& name,
                     const Read& read, const std::string& instead, const std::function<int()>& substitute);
    Bitmap read_picture(const std::string& file);
    int add_texture(Bitmap bitmap);
    int add_mask(const Bitmap& bitmap);

    std::filesystem::path obj_path;
    std::int64_t pixels_left = max_texture_pixels;
    Known known_textures, known_masks;
    std::map<int, int> texture_masks; ///< from index in `bitmaps` to index in `masks`
};

/// Returns the text of an .mtl file reduced to the statements we use, with each number checked and an unset
/// Kd written as `unset`. Warns about statements that are not supported.
std::string scan_mtl(const std::string& path, std::string text);
inline constexpr float unset = -1;

/// Converts a material; numbers out of range are clamped, with a warning.
ObjMaterial convert_material(const tinyobj::material_t& source, const std::filesystem::path& mtl,
                             TextureLoader& textures);

} // namespace rt
