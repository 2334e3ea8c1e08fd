// What the world is made of: one vector per kind of shape, materials by number, and a sky around it all.
#pragma once

#include "01_spheres/background.h"
#include "01_spheres/diffuse.h"
#include "01_spheres/plane.h"
#include "01_spheres/sphere.h"
#include "02_shadows/light.h"
#include "03_mirror/mirror.h"
#include "03_mirror/quad.h"
#include "04_refraction/glass.h"
#include "05_mesh_bvh/bvh.h"
#include "05_mesh_bvh/mesh.h"
#include "common/match.h"
#include "common/tally.h"

#include <algorithm>
#include <variant>
#include <vector>

namespace rt {

using Material = std::variant<Diffuse, Checker, Mirror, Reflective, Glass>;

/// How a ray looks for what it meets: by asking every shape, or by descending a tree.
enum class Accel { brute, bvh };

struct Scene {
    Sky sky;
    std::vector<Sphere> spheres;
    std::vector<Plane> planes;
    std::vector<Quad> quads;
    Mesh mesh;
    std::vector<PointLight> lights;
    std::vector<Material> materials;
    Accel accel = Accel::bvh;
    Bvh sphere_tree;   ///< made by prepare(), as is
    Bvh triangle_tree; ///< this one
};

/// Puts a material into the scene and answers its number.
inline int add(Scene& scene, const Material& material) {
    scene.materials.push_back(material);
    return int(scene.materials.size()) - 1;
}

/// Puts a material of a model into the scene and answers its number: matte, under a mirror if it is
/// reflective; or glass.
inline int add(Scene& scene, const ObjMaterial& material) {
    if (material.glass) return add(scene, Glass{{material.ior}});
    const int base = add(scene, Diffuse{material.diffuse, material.emission});
    if (material.reflectivity == 0) return base;
    return add(scene, Reflective{material.reflectivity, base});
}

/// Puts a model into the scene, with its materials. `crease` as in smooth_normals().
inline void add(Scene& scene, const ObjFile& file, float crease) {
    std::vector<int> numbers;
    for (const ObjMaterial& material : file.material_list) numbers.push_back(add(scene, material));
    append(scene.mesh, file, numbers, crease);
}

/// Builds the trees. Call it once, when all shapes are in place.
inline void prepare(Scene& scene) {
    std::vector<Box> boxes;
    for (const Sphere& sphere : scene.spheres) boxes.push_back(bounds(sphere));
    scene.sphere_tree = build_bvh(boxes);
    boxes.clear();
    for (std::uint32_t i = 0; i < scene.mesh.triangles.size(); ++i) boxes.push_back(bounds(scene.mesh, i));
    scene.triangle_tree = build_bvh(boxes);
}

/// Calls test(i) for all shapes that the ray may meet, until one answers true.
template <typename Test>
void search(Accel accel, const Bvh& tree, std::size_t count, const Ray& ray, Test&& test) {
    if (accel == Accel::bvh) return traverse(tree, ray, test);
    for (std::uint32_t i = 0; i < count; ++i)
        if (test(i)) return;
}

/// What the ray meets first. Each hit shortens the ray, so the last one found is the nearest; only that one
/// is worked out in full.
inline std::optional<Hit> intersect(const Scene& scene, Ray ray) {
    ++tally.rays;
    std::variant<std::monostate, const Sphere*, const Plane*, const Quad*, MeshHit> nearest;
    const auto test = [&](const auto& shape) {
        if (const auto t = intersect(shape, ray)) {
            ray.t_max = *t;
            nearest = &shape;
        }
        return false;
    };
    for (const Plane& plane : scene.planes) test(plane);
    for (const Quad& quad : scene.quads) test(quad);
    search(scene.accel, scene.sphere_tree, scene.spheres.size(), ray,
           [&](std::uint32_t i) { return test(scene.spheres[i]); });
    search(scene.accel, scene.triangle_tree, scene.mesh.triangles.size(), ray, [&](std::uint32_t i) {
        //> a triangle that is hit shortens the ray too
        const auto [a, b, c] = corners(scene.mesh, i);
        if (const auto hit = intersect(a, b, c, ray)) {
            ray.t_max = hit->t;
            nearest = MeshHit{&scene.mesh, i, hit->u, hit->v};
        }
        //<
        return false;
    });
    return match(
        nearest, [](std::monostate) { return std::optional<Hit>(); },
        [&](const auto* shape) { return std::optional(surface(*shape, ray)); },
        [&](const MeshHit& found) { return std::optional(surface(found, ray)); });
}

/// Whether anything at all stands in the ray's interval: the first shape that does ends the search.
inline bool occluded(const Scene& scene, const Ray& ray) {
    ++tally.rays;
    bool found = false;
    const auto test = [&](const auto& shape) { return found = intersect(shape, ray).has_value(); };
    if (std::ranges::any_of(scene.planes, test) || std::ranges::any_of(scene.quads, test)) return true;
    search(scene.accel, scene.sphere_tree, scene.spheres.size(), ray,
           [&](std::uint32_t i) { return test(scene.spheres[i]); });
    if (found) return true;
    search(scene.accel, scene.triangle_tree, scene.mesh.triangles.size(), ray, [&](std::uint32_t i) {
        const auto [a, b, c] = corners(scene.mesh, i);
        return found = intersect(a, b, c, ray).has_value();
    });
    return found;
}

} // namespace rt
