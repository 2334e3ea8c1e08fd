// Forced in front of a step's main.cpp: the program's scene becomes one that tells profiled.cpp what the
// program is doing. RT_SCENE is the scene.h that the program uses. The program is not changed.
#pragma once

#include RT_SCENE

#include "tools/bench/phase.h"

#include <concepts>
#include <optional>

namespace rt {

/// A Scene in every respect; but being another type, it is passed to the functions below, which fit it
/// better.
struct ProfiledScene : Scene {};

/// The plain scene; a template, so that a function that a step lacks is looked up only where it is used.
template <typename S>
struct Plain {
    using type = Scene;
};

template <std::same_as<ProfiledScene> S>
std::optional<Hit> intersect(const S& scene, const Ray& ray) {
    const bench::PhaseScope traversal(bench::Phase::traversal, bench::Phase::shading);
    return intersect(static_cast<const typename Plain<S>::type&>(scene), ray);
}

template <std::same_as<ProfiledScene> S>
bool occluded(const S& scene, const Ray& ray) {
    const bench::PhaseScope traversal(bench::Phase::traversal, bench::Phase::shading);
    return occluded(static_cast<const typename Plain<S>::type&>(scene), ray);
}

/// Builds the trees, from step 05 on.
template <std::same_as<ProfiledScene> S>
void build_bvhs(S& scene) {
    const bench::PhaseScope build(bench::Phase::build, bench::Phase::scene);
    build_bvhs(static_cast<typename Plain<S>::type&>(scene));
}

} // namespace rt

#define Scene ProfiledScene
