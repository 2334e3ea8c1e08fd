// The small parts of a renderer, each alone, by Google Benchmark.
#include "01_spheres/camera.h"
#include "01_spheres/sphere.h"
#include "04_refraction/dielectric.h"
#include "05_mesh_bvh/aabb.h"
#include "05_mesh_bvh/triangle.h"
#include "06_textures/texture.h"
#include "08_indirect/hemisphere.h"
#include "accel/accel.h"
#include "common/math/random.h"
#include "common/util/paths.h"
#include "common/util/report_error.h"
#include "tools/compare/flip.h"

#include <benchmark/benchmark.h>

namespace rt::bench {
namespace {

constexpr std::size_t input_count = 1024; ///< a power of two: too many for a branch predictor to learn them

/// Registers a kernel, which is called with 0, 1, ..., input_count - 1, 0, ...
void add_kernel(const char* name, auto kernel) {
    benchmark::RegisterBenchmark(name, [kernel](benchmark::State& state) mutable {
        std::size_t i = 0;
        for (auto _ : state) {
            benchmark::DoNotOptimize(kernel(i));
            i = (i + 1) % input_count;
        }
        state.SetItemsProcessed(state.iterations());
    });
}

/// Returns the results of make(random), as inputs of a kernel.
auto inputs(auto make) {
    Random random(4);
    std::vector<decltype(make(random))> made;
    for (std::size_t i = 0; i < input_count; ++i) made.push_back(make(random));
    return made;
}

/// Returns a ray from around the origin, in a direction around the z axis.
Ray random_ray(Random& random) {
    const vec3 origin(random.get_1d(), random.get_1d(), random.get_1d());
    return {origin - 0.5f, sample_cosine_hemisphere({0, 0, 1}, random.get_2d())};
}

const std::vector<Ray> rays = inputs(random_ray);
const std::vector<vec2> numbers = inputs([](Random& random) { return random.get_2d(); });

void add_lesson_kernels() {
    static const auto slabs = inputs([](Random& random) { return slab_ray(random_ray(random)); });
    static const Texture globe = make_texture(read_bitmap(asset_path("globe.png")));
    const Aabb box{{-0.5f, -0.5f, 1}, {0.5f, 0.5f, 2}};
    const Sphere sphere{{0, 0, 2}, 1, 0};
    const Camera camera = make_camera({.from = {0, 1, 4}, .at = {0, 0, 0}}, 640, 400);
    const vec3 a(-1, -1, 1), b(1, -1, 1), c(0, 1, 1);
    using Index = std::size_t;
    add_kernel("ray and box", [=](Index i) { return intersect(box, slabs[i], 0, infinity); });
    add_kernel("ray and triangle", [=](Index i) { return intersect(a, b, c, rays[i]); });
    add_kernel("ray and sphere", [=](Index i) { return intersect(sphere, rays[i]); });
    add_kernel("random number", [random = Random(5)](Index) mutable { return random.get_1d(); });
    add_kernel("Fresnel", [](Index i) { return fresnel_dielectric(numbers[i].x, 1 / 1.5f); });
    add_kernel("texture, bilinear", [](Index i) { return bilinear(globe, numbers[i]); });
    add_kernel("cosine direction",
               [](Index i) { return sample_cosine_hemisphere(rays[i].direction, numbers[i]); });
    add_kernel("camera ray", [=](Index i) { return camera_ray(camera, 400.0f * numbers[i]); });
}

template <typename Block>
void add_block(const char* name, const Block& block) {
    static const auto prepared = inputs([](Random& random) { return Block::make_ray(random_ray(random)); });
    add_kernel(name, [block](std::size_t i) { return candidates(block, prepared[i], 0, infinity).maybe; });
}

/// Adds the kernels of the fast tree: all lanes together.
void add_tree_kernels() {
    static const auto prepared = inputs([](Random& random) { return accel::wide_ray(random_ray(random)); });
    accel::WideNode node{};
    accel::TriangleN triangles{};
    accel::SphereN spheres{};
    for (int lane = 0; lane < accel::simd_width; ++lane) {
        for (int axis = 0; axis < 3; ++axis) {
            node.bounds[axis][0][lane] = float(lane % 4) / 4 + (axis == 2 ? 1.0f : -0.5f);
            node.bounds[axis][1][lane] = node.bounds[axis][0][lane] + 0.3f;
        }
        const float z = 1 + float(lane) / 8;
        set_lane(triangles, lane, {vec3(-1, -1, z), vec3(1, -1, z), vec3(0, 1, z)}, std::uint32_t(lane));
        const vec3 center(float(lane % 4) - 1.5f, float(lane / 4) - 1.5f, 2);
        set_lane(spheres, lane, accel::Sphere{center, 0.5f}, std::uint32_t(lane));
    }
    add_kernel("ray and the boxes of a node", [node](std::size_t i) {
        accel::FloatN t;
        return intersect_children(node, prepared[i], accel::broadcast(infinity), t);
    });
    add_block("ray and a block of triangles", triangles);
    add_block("ray and a block of spheres", spheres);
}

/// Compares images of random colours.
void flip_images(benchmark::State& state) {
    Random random(3);
    Image a(1024, 768), b(1024, 768);
    for (Image* image : {&a, &b})
        for (vec3& pixel : image->pixels) pixel = {random.get_1d(), random.get_1d(), random.get_1d()};
    for (auto _ : state) benchmark::DoNotOptimize(rt::compare::flip(a, b).mean);
}

} // namespace
} // namespace rt::bench

int main(int argc, char** argv) {
    using namespace rt::bench;
    benchmark::Initialize(&argc, argv);
    if (argc > 1)
        return rt::report_error("bench_kernels",
                                std::string(argv[1]) + " is not known; --help lists the flags");
    add_lesson_kernels();
    add_tree_kernels();
    benchmark::RegisterBenchmark("FLIP, 1024 x 768", flip_images)->Unit(benchmark::kMillisecond);
    benchmark::RunSpecifiedBenchmarks();
    benchmark::Shutdown();
}
