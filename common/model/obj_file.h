// A Wavefront OBJ file and its MTL materials as plain arrays, checked and triangulated.
#pragma once

#include "common/image/image_file.h"
#include "common/math/vec.h"

#include <array>
#include <string>
#include <vector>

namespace rt {

/// A material as the MTL file states it. Colours are linear; `emission` is not clamped to 1.
struct ObjMaterial {
    std::string name;
    vec3 diffuse{0.6f};     ///< Kd, in [0, 1]; the default is used if the .mtl is missing
    vec3 emission{0.0f};    ///< Ke, radiance, W / (m^2 sr), >= 0
    float reflectivity = 0; ///< in [0, 1]: Pm, or the mean of Ks if illum requests reflection (3, 5, 8)
    float ior = 1;          ///< Ni, index of refraction, in [1, 4]
    bool glass = false;     ///< refraction is requested: illum 4, 6, 7 or 9, or d < 1 together with Ni > 1
    int texture = -1;       ///< map_Kd: index into ObjModel::textures, -1: none
    int mask = -1;          ///< map_d, or the alpha of map_Kd: index into ObjModel::masks, -1: no holes
};

/// One vertex of a face: indices into the arrays, -1 where the file gives none.
struct ObjIndex {
    int position = -1;
    int uv = -1;
    int normal = -1;
};

/// The model of an OBJ file. Every index is in range and every number is finite, so users
/// need no further checks.
struct ObjModel {
    glm::dvec3 origin{0}; ///< the point in file coordinates that is (0, 0, 0) in `positions`
    std::vector<vec3> positions;
    std::vector<vec3> normals; ///< as given: not necessarily unit length, never zero
    std::vector<vec2> uvs;
    std::vector<vec3> colors; ///< one per position: linear RGB in [0, 1]; empty if the file gives none
    std::vector<std::array<ObjIndex, 3>> triangles; ///< triangulated polygons, counter-clockwise
    std::vector<int> smoothing_groups;              ///< one per triangle: 0 flat, -1 not stated; may be empty
    std::vector<int> triangle_materials;            ///< one per triangle: index into `materials`
    std::vector<ObjMaterial> materials;             ///< at least one
    std::vector<Bitmap> textures;                   ///< a magenta checker replaces a missing one
    std::vector<Mask> masks;                        ///< each has at least one hole
};

/// How reading is split into work units. The result does not depend on it.
struct ObjReadOptions {
    int threads = 0;                                ///< 0: one per core
    std::size_t chunk_bytes = std::size_t(1) << 20; ///< text that a thread takes at a time, at least 1
};

/// Reads an OBJ file, its .mtl files and its textures. A model that is far from the origin relative to
/// its size is moved to the origin before its coordinates become floats. Faces wound against their
/// normals are flipped. Warnings (a missing .mtl or texture, with the paths tried; lines that are read
/// only in part, with a count) go to stderr, one line each. Throws Error, with file and line where known,
/// if the file is missing, a folder, not an OBJ file or without faces; if a position index is out of
/// range or a position is not finite; if a face has fewer than three vertices; or if the model is smaller
/// than 1e-15 or larger than 1e16.
ObjModel read_obj(const std::string& path, const ObjReadOptions& reading = {});

} // namespace rt
