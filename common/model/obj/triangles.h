// Faces cut into triangles, without those that have no area, each turned to the side that its normals show.
#pragma once

#include "common/model/obj_file.h"

#include <cstddef>
#include <span>
#include <vector>

namespace rt {

/// What all triangles of a face share.
struct FaceTraits {
    int material;
    int smoothing; ///< as in ObjModel::smoothing_groups
};

/// The positions of a triangle's corners, in their order around it, from the least on.
using TriangleKey = std::array<std::array<float, 3>, 3>;

/// Collects the triangles of a file.
class Triangles {
  public:
    /// `file_` has its positions and normals. `with_smoothing`: it shall get smoothing groups.
    Triangles(ObjModel& file_, bool with_smoothing_) : file(file_), with_smoothing(with_smoothing_) {}

    void add_face(std::span<const ObjIndex> corners, const FaceTraits& traits);
    std::size_t without_area() const { return dropped; }

    /// Turns the faces that wind against their normals, as mirrored exports have them. Returns how many there
    /// are, not counting those that are the back of another face with the same corners.
    std::size_t turn_faces();

  private:
    /// A face that winds against its normals.
    struct Against {
        std::size_t begin, end; ///< its triangles
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
    /// Three corners in a row, backwards, of one of `against`, and which.
    std::vector<std::pair<TriangleKey, std::size_t>> keys;
};

} // namespace rt
