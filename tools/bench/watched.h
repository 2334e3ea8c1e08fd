// Forced in front of a step's main.cpp: the program's scene becomes one that says what the program is at, so
// that watched.cpp can see where the time goes. RT_SCENE is the scene.h that the program uses. The program is
// not changed.
#pragma once

#include RT_SCENE

#include "tools/bench/phase.h"

#include <concepts>
#include <optional>

namespace rt {

/// A Scene in every respect; but being another type, it is passed to the functions below, which fit it
/// better.
struct WatchedScene : Scene {};

/// The plain scene; a template, so that what a step does not have is looked up only where it is used.
template <typename S>
struct Plain {
    using type = Scene;
};

template <std::same_as<WatchedScene> S>
std::optional<Hit> intersect(const S& scene, const Ray& ray) {
    const bench::During traversal(bench::Phase::traversal, bench::Phase::shading);
    return intersect(static_cast<const typename Plain<S>::type&>(scene), ray);
}

template <std::same_as<WatchedScene> S>
bool occluded(const S& scene, const Ray& ray) {
    const bench::During traversal(bench::Phase::traversal, bench::Phase::shading);
    return occluded(static_cast<const typename Plain<S>::type&>(scene), ray);
}

/// Builds the trees, from step 05 on.
template <std::same_as<WatchedScene> S>
void build_bvhs(S& scene) {
    const bench::During build(bench::Phase::build, bench::Phase::scene);
    build_bvhs(static_cast<typename Plain<S>::type&>(scene));
}

} // namespace rt

#define Scene WatchedScene
