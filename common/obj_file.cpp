// A Wavefront OBJ file as plain arrays: read, scanned, parsed by tinyobjloader, cut into triangles, cleaned.
#include "common/obj_file.h"

#include "common/error.h"
#include "common/file_bytes.h"
#include "common/obj/material.h"
#include "common/obj/polygon.h"
#include "common/obj/scan.h"

#include <algorithm>
#include <cmath>
#include <istream>
#include <streambuf>

namespace rt {
namespace {

/// Lets a stream read a string without a copy of it.
struct TextBuffer : std::streambuf {
    explicit TextBuffer(std::string& text) { setg(text.data(), text.data(), text.data() + text.size()); }
};

/// What tinyobjloader answers: one shape, because the scan hides groups and objects from it.
struct Parsed {
    tinyobj::attrib_t attributes;
    tinyobj::mesh_t mesh;
    std::vector<tinyobj::material_t> materials;
};

Parsed parse(const std::string& path, std::string& text, MaterialLibraries& libraries) {
    Parsed parsed;
    std::vector<tinyobj::shape_t> shapes;
    std::string warnings, errors;
    TextBuffer buffer(text);
    std::istream stream(&buffer);
    const bool triangulate = false, colours_too = false;
    if (!tinyobj::LoadObj(&parsed.attributes, &shapes, &parsed.materials, &warnings, &errors, &stream,
                          &libraries, triangulate, colours_too) ||
        shapes.size() != 1)
        throw Error(path + ": cannot be read as an OBJ file (" + errors.substr(0, errors.find('\n')) + ")");
    parsed.mesh = std::move(shapes[0].mesh);
    return parsed;
}

/// Numbers in a row as vectors; the row's memory is given back.
template <typename Vector>
std::vector<Vector> vectors(std::vector<float>& numbers) {
    std::vector<Vector> out(numbers.size() / std::size_t(Vector::length()));
    const float* number = numbers.data();
    for (Vector& vector : out) {
        for (int i = 0; i < Vector::length(); ++i) vector[i] = *number++;
    }
    std::vector<float>().swap(numbers);
    return out;
}

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
    void add_polygon(const std::vector<ObjCorner>& corners, int material) {
        std::vector<vec3> places;
        for (const ObjCorner& corner : corners)
            places.push_back(file.positions[std::size_t(corner.position)]);
        for (const auto& [a, b, c] : cut_polygon(places))
            add({corners[std::size_t(a)], corners[std::size_t(b)], corners[std::size_t(c)]}, material);
    }
};

ObjCorner corner_of(const tinyobj::index_t& index) {
    return {index.vertex_index, index.texcoord_index, index.normal_index};
}

/// Faces into triangles. `file.materials` holds tinyobjloader's numbers then.
void cut_faces(const std::string& path, const Parsed& parsed, const ObjScan& scan, ObjFile& file) {
    Triangles triangles{file};
    file.triangles.reserve(scan.face_sizes.size());
    file.materials.reserve(scan.face_sizes.size());
    const tinyobj::index_t* index = parsed.mesh.indices.data();
    for (std::size_t face = 0; face < scan.face_sizes.size(); ++face) {
        const int size = scan.face_sizes[face], material = parsed.mesh.material_ids[face];
        if (size == 3) {
            triangles.add({corner_of(index[0]), corner_of(index[1]), corner_of(index[2])}, material);
        } else {
            std::vector<ObjCorner> corners(std::size_t(size), ObjCorner{});
            std::transform(index, index + size, corners.begin(), corner_of);
            triangles.add_polygon(corners, material);
        }
        index += size;
    }
    if (file.triangles.empty()) throw Error(path + ": none of its faces has an area");
    if (triangles.dropped > 0)
        warn(path + ": " + std::to_string(triangles.dropped) + " triangles without area are left out");
}

/// A normal that has no direction is as good as none.
void drop_wrong_normals(ObjFile& file) {
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
void keep_used_materials(const std::string& path, const Parsed& parsed, const MaterialLibraries& libraries,
                         ObjFile& file) {
    const std::size_t count =
        parsed.materials.size(); // number `count` is the default, which tinyobjloader calls -1
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
            i < count ? converted(parsed.materials[i], libraries.file_of(i), textures) : ObjMaterial{});
    }
    for (int& material : file.materials) material = number[std::size_t(material)];
    file.textures = std::move(textures.bitmaps);
}

void warn_of_unknown_materials(const std::string& path, const ObjScan& scan, const Parsed& parsed,
                               const MaterialLibraries& libraries) {
    if (!scan.names_library && !scan.materials.empty())
        warn(path + ": names materials (usemtl) but no material file (mtllib); they are grey");
    if (!libraries.found_any()) return;
    for (const auto& [name, line] : scan.materials) {
        const auto has_name = [&name = name](const tinyobj::material_t& m) { return m.name == name; };
        if (std::none_of(parsed.materials.begin(), parsed.materials.end(), has_name))
            warn(at_line(path, line,
                         "material " + in_quotes(name) + " is in none of the material files; it is grey"));
    }
}

} // namespace

ObjFile read_obj(const std::string& path) {
    std::string text = read_file(path);
    if (text.empty()) throw Error(path + ": is empty");
    const ObjScan scan = scan_obj(path, text);
    MaterialLibraries libraries(path);
    Parsed parsed = parse(path, text, libraries);
    std::string().swap(text);
    warn_of_unknown_materials(path, scan, parsed, libraries);

    ObjFile file;
    file.positions = vectors<vec3>(parsed.attributes.vertices);
    file.normals = vectors<vec3>(parsed.attributes.normals);
    file.uvs = vectors<vec2>(parsed.attributes.texcoords);
    cut_faces(path, parsed, scan, file);
    drop_wrong_normals(file);
    keep_used_materials(path, parsed, libraries, file);
    return file;
}

} // namespace rt
