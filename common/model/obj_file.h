// A Wavefront OBJ file and its MTL materials as plain arrays: checked, triangulated, and nothing more.
#pragma once

#include "common/image/image_file.h"
#include "common/math/vec.h"

#include <array>
#include <string>
#include <vector>

namespace rt {

/// A material as the MTL file states it. Colours are linear, not clamped to 1 for `emission`.
struct ObjMaterial {
    std::string name;
    vec3 diffuse{0.6f};     ///< Kd, in [0, 1]; the default stands for a missing .mtl
    vec3 emission{0.0f};    ///< Ke, radiance, W / (m^2 sr), >= 0
    float reflectivity = 0; ///< in [0, 1]: the mean of Ks where illum asks for reflection (3, 5, 8), or Pm
    float ior = 1;          ///< Ni, index of refraction, in [1, 4]
    bool glass = false;     ///< refraction is asked for: illum 4, 6, 7 or 9, or d < 1 together with Ni > 1
    int texture = -1;       ///< map_Kd: index into ObjModel::textures, -1 for none
    int mask = -1;          ///< map_d, or the alpha of map_Kd: index into ObjModel::masks, -1 for no holes
};

/// One corner of a face: indices into the arrays, -1 where the file gives none.
struct ObjIndex {
    int position = -1;
    int uv = -1;
    int normal = -1;
};

/// Every index is in range and every number finite: whoever reads these arrays need not look again.
struct ObjModel {
    glm::dvec3 origin{0}; ///< the point of the file's coordinates that is (0, 0, 0) in `positions`
    std::vector<vec3> positions;
    std::vector<vec3> normals; ///< as given: not necessarily of unit length, never zero
    std::vector<vec2> uvs;
    std::vector<vec3> colors; ///< one per position: linear RGB in [0, 1]; empty if the file gives none
    std::vector<std::array<ObjIndex, 3>> triangles; ///< polygons cut into triangles, counter-clockwise kept
    std::vector<int> smoothing_groups;              ///< one per triangle: 0 flat, -1 not stated; or empty
    std::vector<int> triangle_materials;            ///< one per triangle: index into `materials`
    std::vector<ObjMaterial> materials;             ///< at least one
    std::vector<Bitmap> textures;                   ///< a missing one is a magenta checker
    std::vector<Mask> masks;                        ///< each has a hole somewhere
};

/// How the work of reading is divided; the result does not depend on it.
struct ObjReadOptions {
    int threads = 0;                                ///< 0: one for each core
    std::size_t chunk_bytes = std::size_t(1) << 20; ///< of text that a thread takes at a time, at least 1
};

/// Reads an OBJ file, its .mtl and its textures. A model that is far from the origin for its size is moved
/// there before its coordinates become floats. A face that winds against its normals is turned. Warnings
/// (missing .mtl or texture, with the paths tried; lines that are read only in part, counted) go to stderr,
/// one line each. Throws Error, with file and line where it can be known, for a file that is missing, a
/// folder, empty of faces or not OBJ at all, a position that does not exist or is not finite, a face of fewer
/// than three corners, a model smaller than 1e-15 or larger than 1e16.
ObjModel read_obj(const std::string& path, const ObjReadOptions& reading = {});

} // namespace rt
