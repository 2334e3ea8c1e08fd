// Triangulates faces, drops triangles without area, and orients each face by its normals.
#pragma once

#include "common/model/obj_file.h"

#include <cstddef>
#include <span>
#include <vector>

namespace rt {

/// Attributes shared by all triangles of a face.
struct FaceTraits {
    int material;
    int smoothing; ///< as in ObjModel::smoothing_groups
};

/// The vertex positions of a triangle, in their cyclic order, starting at the smallest.
using TriangleKey = std::array<std::array<float, 3>, 3>;

/// Collects the triangles of a model.
class Triangles {
  public:
    /// `file_` must already have its positions and normals. `with_smoothing`: also store smoothing groups.
    Triangles(ObjModel& file_, bool with_smoothing_) : file(file_), with_smoothing(with_smoothing_) {}

    void add_face(std::span<const ObjIndex> corners, const FaceTraits& traits);
    std::size_t without_area() const { return dropped; }

    /// Flips the faces that wind against their normals, as in mirrored exports. Returns their number, without
    /// those that are the back of another face with the same vertices.
    std::size_t turn_faces();

  private:
    /// A face that winds against its normals.
    struct Against {
        std::size_t begin, end; ///< range of its triangles
        bool is_back = false;
    };
    void add(const std::array<ObjIndex, 3>& triangle, const FaceTraits& traits);
    bool winds_against(std::span<const ObjIndex> corners, std::size_t begin) const;
    TriangleKey key(const ObjIndex& a, const ObjIndex& b, const ObjIndex& c) const;
    void find_backs();

    ObjModel& file;
    bool with_smoothing;
    std::size_t dropped = 0;
    std::vector<Against> against;
    /// Three consecutive vertices of a face of `against`, reversed, and the index of that face.
    std::vector<std::pair<TriangleKey, std::size_t>> keys;
};

} // namespace rt
