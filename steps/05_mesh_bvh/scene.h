// What the world is made of: shapes, materials by index, lights, and a sky around it all.
#pragma once

#include "01_spheres/checkerboard.h"
#include "01_spheres/diffuse.h"
#include "01_spheres/sky.h"
#include "02_shadows/point_light.h"
#include "03_mirror/mirror.h"
#include "04_refraction/dielectric.h"
#include "05_mesh_bvh/build_bvhs.h"
#include "common/util/add.h"

#include <variant>
#include <vector>

namespace rt {

using Material = std::variant<Diffuse, Checkerboard, Mirror, Coated, Dielectric>;

struct Scene : Shapes {
    Sky sky;
    std::vector<PointLight> lights;
    std::vector<Material> materials;
};

/// Appends a material of a model and returns its index: diffuse, coated if it is reflective; or a dielectric.
inline int add_material(Scene& scene, const ObjMaterial& material) {
    if (material.glass) return add(scene.materials, Dielectric{{material.ior}});
    const int base = add(scene.materials, Diffuse{material.diffuse, material.emission});
    if (material.reflectivity == 0) return base;
    return add(scene.materials, Coated{material.reflectivity, base});
}

/// Adds a model with its materials. `crease_angle` as in smooth_normals().
inline void add_model(Scene& scene, const ObjModel& file, float crease_angle) {
    std::vector<int> material_ids;
    for (const ObjMaterial& material : file.materials) material_ids.push_back(add_material(scene, material));
    append_model(scene.mesh, file, material_ids, crease_angle);
}

} // namespace rt
