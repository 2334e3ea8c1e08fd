// A Wavefront OBJ file as plain arrays: read, scanned and parsed by tinyobjloader in chunks, which are put
// together here; then cut into triangles and cleaned.
#include "common/obj_file.h"

#include "common/error.h"
#include "common/obj/chunks.h"
#include "common/obj/find_file.h"
#include "common/obj/material.h"
#include "common/obj/polygon.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <span>

namespace rt {
namespace {

/// A direction that can be scaled to unit length in floats.
bool is_direction(vec3 v) {
    const float square = dot(v, v);
    return square > 0 && std::isfinite(square);
}

bool has_area(const std::vector<vec3>& positions, const std::array<ObjCorner, 3>& triangle) {
    const vec3 a = positions[std::size_t(triangle[0].position)];
    const vec3 b = positions[std::size_t(triangle[1].position)];
    const vec3 c = positions[std::size_t(triangle[2].position)];
    return is_direction(cross(b - a, c - a));
}

/// Collects triangles, without those that have no area.
struct Triangles {
    ObjFile& file;
    std::size_t dropped = 0;

    void add(const std::array<ObjCorner, 3>& triangle, int material) {
        if (!has_area(file.positions, triangle)) {
            ++dropped;
            return;
        }
        file.triangles.push_back(triangle);
        file.materials.push_back(material);
    }
    void add_polygon(std::span<const ObjCorner> corners, int material) {
        std::vector<vec3> places;
        for (const ObjCorner& corner : corners)
            places.push_back(file.positions[std::size_t(corner.position)]);
        for (const auto& [a, b, c] : cut_polygon(places))
            add({corners[std::size_t(a)], corners[std::size_t(b)], corners[std::size_t(c)]}, material);
    }
};

/// Puts `rows` behind `all` and gives their memory back.
template <typename Row>
void move_to_end(std::vector<Row>& all, std::vector<Row>& rows) {
    all.insert(all.end(), rows.begin(), rows.end());
    std::vector<Row>().swap(rows);
}

/// Puts the vertices of all chunks together, so that no corner is relative to a chunk any more.
void join_vertices(const ObjScan& scan, std::deque<Chunk>& chunks, ObjFile& file) {
    file.positions.reserve(std::size_t(scan.counts[Numbered::position]));
    file.uvs.reserve(std::size_t(scan.counts[Numbered::uv]));
    file.normals.reserve(std::size_t(scan.counts[Numbered::normal]));
    for (Chunk& chunk : chunks) {
        ParsedChunk& parsed = chunk.parsed;
        for (const std::size_t i : parsed.relative[Numbered::position])
            parsed.corners[i].position += int(file.positions.size());
        for (const std::size_t i : parsed.relative[Numbered::uv])
            parsed.corners[i].uv += int(file.uvs.size());
        for (const std::size_t i : parsed.relative[Numbered::normal])
            parsed.corners[i].normal += int(file.normals.size());
        move_to_end(file.positions, parsed.positions);
        move_to_end(file.uvs, parsed.uvs);
        move_to_end(file.normals, parsed.normals);
    }
}

/// The materials of the file and its libraries, while its lines are read in order.
class Materials {
  public:
    explicit Materials(const std::string& path) : libraries(path) {}

    void read(const MaterialLine& line) {
        if (!line.is_library) {
            const auto place = numbers.find(unquoted(line.name));
            current = place == numbers.end() ? -1 : place->second;
        } else if (names.insert(line.name).second) {
            std::string warnings, errors;
            libraries(line.name, &list, &numbers, &warnings, &errors);
        }
    }

    int current = -1; ///< -1 is the default
    MaterialLibraries libraries;
    std::vector<tinyobj::material_t> list;

  private:
    std::map<std::string, int> numbers;
    std::set<std::string> names; ///< of the libraries so far
};

/// Each chunk's faces into triangles. `file.materials` holds numbers in `materials.list` then.
void cut_faces(const ObjScan& scan, std::deque<Chunk>& chunks, Materials& materials, Triangles& triangles) {
    triangles.file.triangles.reserve(std::size_t(scan.corners - 2 * scan.faces));
    triangles.file.materials.reserve(std::size_t(scan.corners - 2 * scan.faces));
    for (Chunk& chunk : chunks) {
        const ParsedChunk parsed = std::move(chunk.parsed); // and its memory is given back
        auto line = parsed.material_lines.begin();
        const ObjCorner* corner = parsed.corners.data();
        for (std::size_t face = 0; face < parsed.face_sizes.size(); ++face) {
            while (line != parsed.material_lines.end() && line->face == face) materials.read(*line++);
            const std::size_t size = parsed.face_sizes[face];
            if (size == 3)
                triangles.add({corner[0], corner[1], corner[2]}, materials.current);
            else
                triangles.add_polygon({corner, size}, materials.current);
            corner += size;
        }
        while (line != parsed.material_lines.end()) materials.read(*line++);
    }
}

/// A normal that has no direction is as good as none.
void drop_wrong_normals(ObjFile& file) {
    if (std::all_of(file.normals.begin(), file.normals.end(), is_direction)) return;
    for (std::array<ObjCorner, 3>& triangle : file.triangles) {
        for (ObjCorner& corner : triangle) {
            if (corner.normal >= 0 && !is_direction(file.normals[std::size_t(corner.normal)]))
                corner.normal = -1;
        }
    }
    for (vec3& normal : file.normals) {
        if (!is_direction(normal)) normal = vec3(0, 0, 1); // which no corner names any more
    }
}

/// Converts the materials that are used, in the order of their files; the default, if it is used, comes last.
void keep_used_materials(const std::string& path, const Materials& materials, ObjFile& file) {
    const std::size_t count = materials.list.size(); // stands for the default, which is called -1 so far
    std::vector<int> number(count + 1, -1);
    for (int& material : file.materials) {
        if (material < 0) material = int(count);
        number[std::size_t(material)] = 0;
    }
    TextureLoader textures(path);
    for (std::size_t i = 0; i <= count; ++i) {
        if (number[i] < 0) continue;
        number[i] = int(file.material_list.size());
        file.material_list.push_back(
            i < count ? converted(materials.list[i], materials.libraries.file_of(i), textures)
                      : ObjMaterial{});
    }
    for (int& material : file.materials) material = number[std::size_t(material)];
    file.textures = std::move(textures.bitmaps);
    file.masks = std::move(textures.masks);
    textures.unfollowed.tell();
}

void warn_of_unknown_materials(const std::string& path, const ObjScan& scan, const Materials& materials) {
    if (!scan.names_library && !scan.materials.empty())
        warn(path + ": names materials (usemtl) but no material file (mtllib); they are grey");
    if (!materials.libraries.found_any()) return;
    std::set<std::string_view> known;
    for (const tinyobj::material_t& material : materials.list) known.insert(material.name);
    for (const auto& [name, line] : scan.materials) {
        if (known.count(unquoted(name)) == 0)
            warn(at_line(path, line,
                         "material " + in_quotes(name) + " is in none of the material files; it is grey"));
    }
}

} // namespace

ObjFile read_obj(const std::string& path, const ObjReading& reading) {
    std::deque<Chunk> chunks = read_chunks(path, reading);
    ObjScan scan;
    for (const Chunk& chunk : chunks) scan.add(path, chunk.scan);
    scan.finish(path);

    ObjFile file;
    Materials materials(path);
    Triangles triangles{file};
    join_vertices(scan, chunks, file);
    cut_faces(scan, chunks, materials, triangles);
    warn_of_unknown_materials(path, scan, materials);
    if (file.triangles.empty()) throw Error(path + ": none of its faces has an area");
    if (triangles.dropped > 0)
        warn(path + ": " + std::to_string(triangles.dropped) + " triangles without area are left out");
    drop_wrong_normals(file);
    keep_used_materials(path, materials, file);
    return file;
}

} // namespace rt
