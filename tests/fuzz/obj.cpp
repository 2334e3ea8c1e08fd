// Fuzz target for the whole OBJ reader: the promises of ObjModel, and the same result for any chunk size.
#include "common/model/obj_file.h"
#include "tests/fuzz/fuzz.h"

#include <algorithm>
#include <cstring>

namespace rt::fuzz {

namespace {

bool all_finite(const auto& points) {
    return std::ranges::all_of(points, [](const auto& point) { return is_finite(point); });
}

bool in_range(int index, std::size_t count) {
    return index >= 0 && std::size_t(index) < count;
}

void check_corner(const ObjModel& file, const ObjIndex& corner) {
    require(in_range(corner.position, file.positions.size()), "positions are in range");
    require(corner.uv == -1 || in_range(corner.uv, file.uvs.size()), "texture coordinates are in range");
    require(corner.normal == -1 || in_range(corner.normal, file.normals.size()), "normals are in range");
}

void check_material(const ObjModel& file, const ObjMaterial& material) {
    require(material.texture == -1 || in_range(material.texture, file.textures.size()),
            "textures are in range");
    require(material.mask == -1 || in_range(material.mask, file.masks.size()), "masks are in range");
}

void check_vertices(const ObjModel& file) {
    require(all_finite(file.positions) && all_finite(file.normals), "vectors are finite");
    for (const vec2 uv : file.uvs) require(is_finite(vec3(uv, 0)), "texture coordinates are finite");
    for (const vec3& normal : file.normals) require(normal != vec3(0), "no normal is zero");
    require(file.colors.empty() || file.colors.size() == file.positions.size(), "all positions have colours");
    for (const vec3& color : file.colors)
        require(is_finite(color) && clamp(color, 0.0f, 1.0f) == color, "colours are in [0, 1]");
}

void check_file(const ObjModel& file) {
    require(!file.triangles.empty(), "a file has triangles");
    require(file.triangles.size() == file.triangle_materials.size(), "each triangle has a material");
    const std::size_t groups = file.smoothing_groups.size();
    require(groups == 0 || groups == file.triangles.size(),
            "either all triangles have a smoothing group or none");
    for (const auto& triangle : file.triangles)
        for (const ObjIndex& corner : triangle) check_corner(file, corner);
    for (const int material : file.triangle_materials)
        require(in_range(material, file.materials.size()), "materials are in range");
    for (const ObjMaterial& material : file.materials) check_material(file, material);
    check_vertices(file);
}

template <typename Value>
bool same_bytes(const std::vector<Value>& a, const std::vector<Value>& b) {
    return a.size() == b.size() &&
           (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0);
}

bool same(const ObjModel& a, const ObjModel& b) {
    return a.origin == b.origin && same_bytes(a.positions, b.positions) && same_bytes(a.normals, b.normals) &&
           same_bytes(a.uvs, b.uvs) && same_bytes(a.colors, b.colors) &&
           same_bytes(a.triangles, b.triangles) && same_bytes(a.triangle_materials, b.triangle_materials) &&
           same_bytes(a.smoothing_groups, b.smoothing_groups) &&
           std::ranges::equal(a.materials, b.materials, {}, &ObjMaterial::name, &ObjMaterial::name) &&
           a.textures.size() == b.textures.size() && a.masks.size() == b.masks.size();
}

} // namespace

void run_obj(std::string_view bytes) {
    static const std::string library =
        write_input("m.mtl", "newmtl red\nKd 1 0 0\nnewmtl glass\nd .1\nNi 1.5\n");
    const std::string path = write_input("m.obj", bytes);
    ObjModel whole;
    const std::string refused = refusal([&] { whole = read_obj(path, {1, std::size_t(1) << 20}); });
    if (refused.empty()) check_file(whole);
    for (const ObjReadOptions& reading : {ObjReadOptions{2, 1}, ObjReadOptions{3, 29}}) {
        ObjModel parts;
        require(refusal([&] { parts = read_obj(path, reading); }) == refused,
                "the error does not depend on chunks");
        require(!refused.empty() || same(parts, whole), "the result does not depend on chunks");
    }
}

} // namespace rt::fuzz
