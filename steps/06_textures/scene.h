// What the world is made of: shapes, materials by index, lights, and a sky around it all.
#pragma once

#include "01_spheres/checkerboard.h"
#include "01_spheres/diffuse.h"
#include "01_spheres/sky.h"
#include "02_shadows/point_light.h"
#include "03_mirror/mirror.h"
#include "04_refraction/dielectric.h"
#include "06_textures/cutout.h"
#include "06_textures/texture.h"
#include "05_mesh_bvh/build_bvhs.h"
#include "common/util/add.h"

#include <variant>
#include <vector>

namespace rt {

using Material = std::variant<Diffuse, Checkerboard, Mirror, Coated, Dielectric, ImageTexture>;

struct Scene : CutOutShapes {
    Sky sky;
    std::vector<PointLight> lights;
    std::vector<Material> materials;
    std::vector<Texture> textures;
};

/// Appends a material of a model and returns its index: diffuse or textured, coated if it is reflective; or a
/// dielectric. The model's textures start at index `first_texture`.
inline int add_material(Scene& scene, const ObjMaterial& material, int first_texture) {
    if (material.glass) return add(scene.materials, Dielectric{{material.ior}});
    const int base = material.texture < 0
                         ? add(scene.materials, Diffuse{material.diffuse, material.emission})
                         : add(scene.materials, ImageTexture{first_texture + material.texture,
                                                             material.diffuse, material.emission});
    if (material.reflectivity == 0) return base;
    return add(scene.materials, Coated{material.reflectivity, base});
}

/// Adds a model with its materials, textures and masks. An emissive material has no holes.
/// `crease_angle` as in smooth_normals().
inline void add_model(Scene& scene, const ObjModel& file, float crease_angle) {
    const int first_texture = int(scene.textures.size());
    for (const Bitmap& bitmap : file.textures) add(scene.textures, make_texture(bitmap));
    const int first_mask = int(scene.masks.size());
    for (const Mask& mask : file.masks) add(scene.masks, make_mask(mask));
    std::vector<int> material_ids;
    for (const ObjMaterial& material : file.materials) {
        material_ids.push_back(add_material(scene, material, first_texture));
        if (material.mask >= 0 && material.emission == vec3(0))
            cut_out(scene, material_ids.back(), first_mask + material.mask);
    }
    append_model(scene.mesh, file, material_ids, crease_angle);
}

} // namespace rt
