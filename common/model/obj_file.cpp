// Reads a Wavefront OBJ file: parses chunks, joins them, triangulates the faces, and loads materials.
#include "common/model/obj_file.h"

#include "common/util/error.h"
#include "common/model/obj/chunks.h"
#include "common/model/obj/find_file.h"
#include "common/model/obj/join.h"
#include "common/model/obj/material.h"
#include "common/util/text.h"
#include "common/model/obj/triangles.h"

#include <algorithm>
#include <map>
#include <set>
#include <span>

namespace rt {
namespace {

/// The materials of the file's libraries, and the current one while the lines are read in order.
class Materials {
  public:
    explicit Materials(const std::string& path) : libraries(path) {}

    void read(const MaterialLine& line) {
        if (!line.is_library) {
            const auto place = line.name.empty() ? numbers.end() : numbers.find(unquoted(line.name));
            current = place == numbers.end() ? -1 : place->second;
        } else if (names.insert(line.name).second) {
            std::string warnings, errors;
            libraries(line.name, &list, &numbers, &warnings, &errors);
        }
    }

    int current = -1; ///< -1: the default material
    MaterialLibraries libraries;
    std::vector<tinyobj::material_t> list;

  private:
    std::map<std::string, int> numbers;
    std::set<std::string> names; ///< names of the libraries read so far
};

/// Triangulates the faces of all chunks. Afterwards `file.triangle_materials`
/// holds indices into `materials.list`.
void triangulate_faces(std::deque<ParsedChunk>& chunks, Materials& materials, Triangles& triangles) {
    int smoothing = -1;
    for (ParsedChunk& kept : chunks) {
        const ParsedChunk chunk = std::move(kept); // its memory is freed at the end of this iteration
        auto material = chunk.material_lines.begin();
        auto group = chunk.smoothing_lines.begin();
        const ObjIndex* corner = chunk.corners.data();
        for (std::size_t face = 0; face < chunk.face_sizes.size(); ++face) {
            while (material != chunk.material_lines.end() && material->face == face)
                materials.read(*material++);
            while (group != chunk.smoothing_lines.end() && group->face == face) smoothing = group++->group;
            triangles.add_face({corner, chunk.face_sizes[face]}, {materials.current, smoothing});
            corner += chunk.face_sizes[face];
        }
        while (material != chunk.material_lines.end()) materials.read(*material++);
        if (group != chunk.smoothing_lines.end()) smoothing = chunk.smoothing_lines.back().group;
    }
}

/// Converts the materials that are used, in the order of their files; the default
/// material, if used, comes last.
void keep_used_materials(const std::string& path, const Materials& materials, ObjModel& file) {
    const std::size_t count = materials.list.size(); // the index of the default material, which is -1 so far
    std::vector<int> number(count + 1, -1);
    for (int& material : file.triangle_materials) {
        if (material < 0) material = int(count);
        number[std::size_t(material)] = 0;
    }
    ObjMaterial plain; // the default material: grey, or the vertex colours alone
    if (!file.colors.empty()) plain.diffuse = vec3(1);
    TextureLoader textures(path);
    for (std::size_t i = 0; i <= count; ++i) {
        if (number[i] < 0) continue;
        number[i] = int(file.materials.size());
        file.materials.push_back(
            i < count ? convert_material(materials.list[i], materials.libraries.file_of(i), textures)
                      : plain);
    }
    for (int& material : file.triangle_materials) material = number[std::size_t(material)];
    file.textures = std::move(textures.bitmaps);
    file.masks = std::move(textures.masks);
    textures.unfollowed.tell();
}

void warn_of_unknown_materials(const std::string& path, const ObjSummary& summary,
                               const Materials& materials) {
    if (!summary.names_library && !summary.materials.empty())
        warn(path + ": names materials (usemtl) but no material file (mtllib); they are grey");
    if (!materials.libraries.found_any()) return;
    std::set<std::string_view> known;
    for (const tinyobj::material_t& material : materials.list) known.insert(material.name);
    for (const auto& [name, line] : summary.materials) {
        if (known.count(unquoted(name)) == 0)
            warn(at_line(path, line,
                         "material " + in_quotes(name) + " is in none of the material files; it is grey"));
    }
}

void warn_of_skipped(const std::string& path, const SkippedLines& skipped) {
    const auto say = [&](const Skipped& lines, const std::string& what) {
        if (lines.count == 0) return;
        const std::string others =
            lines.count == 1 ? "" : " (the first of " + std::to_string(lines.count) + ")";
        warn(at_line(path, lines.line, what + others));
    };
    say(skipped.normals, "a normal that is not finite is left out");
    say(skipped.uvs, "a texture coordinate that is not finite is left out");
    say(skipped.materials, "usemtl names no material; the faces that follow get the default one");
    say(skipped.libraries, "mtllib names no file and is left out");
    say(skipped.normal_corners, "a face vertex names a normal that does not exist and gets none");
    say(skipped.uv_corners, "a face vertex names a texture coordinate that does not exist and gets none");
}

} // namespace

ObjModel read_obj(const std::string& path, const ObjReadOptions& reading) {
    ObjModel file;
    std::deque<ParsedChunk> chunks = read_chunks(path, reading);
    const ObjSummary summary = join_chunks(path, chunks, file);
    file.triangles.reserve(summary.corners - 2 * summary.faces);
    file.triangle_materials.reserve(summary.corners - 2 * summary.faces);

    Materials materials(path);
    Triangles triangles(file, summary.has_smoothing);
    triangulate_faces(chunks, materials, triangles);
    warn_of_unknown_materials(path, summary, materials);
    warn_of_skipped(path, summary.skipped);
    if (file.triangles.empty()) throw Error(path + ": none of its faces has an area");
    if (triangles.without_area() > 0)
        warn(path + ": " + std::to_string(triangles.without_area()) + " triangles without area are left out");
    if (const std::size_t turned = triangles.turn_faces(); turned > 0)
        warn(path + ": " + std::to_string(turned) + " of " + std::to_string(summary.faces) +
             " faces wind against their normals and are flipped");
    keep_used_materials(path, materials, file);
    return file;
}

} // namespace rt
