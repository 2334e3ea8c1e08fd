// Scenes of one mesh, with and without a tree, for the checks of step 05 that need a whole scene.
#pragma once

#include "05_mesh_bvh/scene.h"
#include "common/math/random.h"
#include "tests/check.h"
#include "tests/meshes.h"

#include <algorithm>
#include <string>

namespace rt {

inline Scene scene_of(const ObjModel& file, float crease = 40) {
    Scene scene;
    add_model(scene, file, crease);
    build_bvhs(scene);
    return scene;
}

inline Scene with(Scene scene, Accel accel) {
    scene.accel = accel;
    build_bvhs(scene);
    return scene;
}

/// Shoots `count` rays at the box around the scene and compares the tree with testing every shape. If two
/// shapes have the same t, either may be hit, so only t is compared.
inline void check_tree_changes_nothing(const Scene& any, const Aabb& box, int count, std::uint64_t seed = 7) {
    Scene scene = with(any, Accel::bvh);
    Random random(seed);
    const float size = std::max(length(box.max - box.min), 1e-20f);
    int hits = 0, wrong = 0, wrong_shadows = 0;
    std::string first;
    for (int i = 0; i < count; ++i) {
        const vec3 target = mix(box.min, box.max, random_point(random));
        vec3 origin = centroid(box) + size * random_direction(random);
        if (i % 4 == 0) origin = mix(box.min, box.max, random_point(random)); // from inside
        Ray ray{origin, target - origin};
        if (i % 3 == 0) ray.t_max = 1.2f; // a segment
        scene.accel = Accel::brute;
        const auto brute = intersect(scene, ray);
        const bool shadow = occluded(scene, ray);
        scene.accel = Accel::bvh;
        const auto tree = intersect(scene, ray);
        wrong_shadows += occluded(scene, ray) != shadow || shadow != brute.has_value();
        hits += brute.has_value();
        const bool same =
            brute.has_value() == tree.has_value() && (!brute || tree->t == approx(brute->t, 1e-6f));
        if (!same && wrong++ == 0)
            first = "ray " + std::to_string(i) + " from " + to_text(ray.origin) + " along " +
                    to_text(ray.direction) + ": testing every shape gives " +
                    (brute ? "t = " + to_text(brute->t) : "no hit") + ", the tree gives " +
                    (tree ? "t = " + to_text(tree->t) : "no hit");
    }
    INFO(hits, " of ", count, " rays hit");
    CHECK_MESSAGE(wrong == 0, first,
                  " (no hit: a box is too small, or NaN rejects it; too far: the search stopped at the first "
                  "leaf, or continued with an old t_max)");
    CHECK_MESSAGE(wrong_shadows == 0, "occluded() must agree with intersect()");
}

} // namespace rt
