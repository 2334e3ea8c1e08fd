// The small parts of a renderer, each alone and over and over: Google Benchmark's rules of measurement.
#include "02_shadows/point_light.h"
#include "04_refraction/dielectric.h"
#include "05_mesh_bvh/aabb.h"
#include "05_mesh_bvh/triangle.h"
#include "06_textures/texture.h"
#include "08_indirect/hemisphere.h"
#include "common/util/report_error.h"
#include "tools/compare/flip.h"
#include "tools/bench/meshes.h"
#include "tools/bench/ours.h"

#include <benchmark/benchmark.h>

#include <string>
#include <vector>

namespace rt::bench {

namespace {

constexpr std::size_t inputs = 1024; ///< a power of two: enough that no branch predictor learns them by heart

/// Rays from around the origin into all directions.
std::vector<Ray> some_rays() {
    Random random(4);
    std::vector<Ray> rays;
    for (std::size_t i = 0; i < inputs; ++i) {
        const vec3 origin(random.uniform(), random.uniform(), random.uniform());
        rays.push_back({origin - 0.5f, sample_cosine_hemisphere({0, 0, 1}, random.uniform2())});
    }
    return rays;
}

/// Calls kernel(i) for i = 0, 1, ..., inputs - 1, 0, ... and keeps its answers alive.
template <typename Kernel>
void repeat(benchmark::State& state, Kernel&& kernel) {
    std::size_t i = 0;
    for (auto _ : state) {
        benchmark::DoNotOptimize(kernel(i));
        i = (i + 1) % inputs;
    }
    state.SetItemsProcessed(state.iterations());
}

void box(benchmark::State& state) {
    const std::vector<Ray> rays = some_rays();
    std::vector<SlabRay> slabs;
    for (const Ray& ray : rays) slabs.push_back(slab_ray(ray));
    const Aabb target{vec3(-0.5f, -0.5f, 1), vec3(0.5f, 0.5f, 2)};
    repeat(state, [&](std::size_t i) { return intersect(target, slabs[i], 0, infinity); });
}

void triangle(benchmark::State& state) {
    const std::vector<Ray> rays = some_rays();
    const vec3 a(-1, -1, 1), b(1, -1, 1), c(0, 1, 1);
    repeat(state, [&](std::size_t i) { return intersect(a, b, c, rays[i]); });
}

/// All lanes together: the boxes of a node, a block of triangles, a block of spheres.
void node_of_boxes(benchmark::State& state) {
    const std::vector<Ray> rays = some_rays();
    accel::WideNode node{};
    for (int axis = 0; axis < 3; ++axis)
        for (int lane = 0; lane < accel::simd_width; ++lane) {
            node.bounds[axis][0][lane] = float(lane % 4) / 4 + (axis == 2 ? 1.0f : -0.5f);
            node.bounds[axis][1][lane] = node.bounds[axis][0][lane] + 0.3f;
        }
    std::vector<accel::WideRay> wide;
    for (const Ray& ray : rays) wide.push_back(accel::wide_ray(ray));
    repeat(state, [&](std::size_t i) {
        accel::FloatN t;
        return intersect_children(node, wide[i], accel::broadcast(infinity), t);
    });
}

template <typename Block>
void block_of(benchmark::State& state, const Block& block) {
    const std::vector<Ray> rays = some_rays();
    std::vector<decltype(Block::make_ray(rays[0]))> prepared;
    for (const Ray& ray : rays) prepared.push_back(Block::make_ray(ray));
    repeat(state, [&](std::size_t i) { return candidates(block, prepared[i], 0, infinity).maybe; });
}

void block_of_triangles(benchmark::State& state) {
    accel::TriangleN block{};
    for (int lane = 0; lane < accel::simd_width; ++lane) {
        const float z = 1 + float(lane) / 8;
        set_lane(block, lane, {vec3(-1, -1, z), vec3(1, -1, z), vec3(0, 1, z)}, std::uint32_t(lane));
    }
    block_of(state, block);
}

void block_of_spheres(benchmark::State& state) {
    accel::SphereN block{};
    for (int lane = 0; lane < accel::simd_width; ++lane) {
        const vec3 center(float(lane % 4) - 1.5f, float(lane / 4) - 1.5f, 2);
        set_lane(block, lane, accel::Sphere{center, 0.5f}, std::uint32_t(lane));
    }
    block_of(state, block);
}

void sphere(benchmark::State& state) {
    const std::vector<Ray> rays = some_rays();
    const Sphere ball{{0, 0, 2}, 1, 0};
    repeat(state, [&](std::size_t i) { return intersect(ball, rays[i]); });
}

void random_number(benchmark::State& state) {
    Random random(5);
    repeat(state, [&](std::size_t) { return random.uniform(); });
}

void fresnel_term(benchmark::State& state) {
    Random random(6);
    std::vector<float> cosines(inputs);
    for (float& cosine : cosines) cosine = random.uniform();
    repeat(state, [&](std::size_t i) { return fresnel_dielectric(cosines[i], 1 / 1.5f); });
}

void texture(benchmark::State& state) {
    const Texture picture = make_texture(read_bitmap(asset_path("globe.png")));
    Random random(7);
    std::vector<vec2> uvs(inputs);
    for (vec2& uv : uvs) uv = random.uniform2();
    repeat(state, [&](std::size_t i) { return bilinear(picture, uvs[i]); });
}

void bounce(benchmark::State& state) {
    Random random(8);
    std::vector<vec2> squares(inputs);
    for (vec2& u : squares) u = random.uniform2();
    const std::vector<Ray> rays = some_rays();
    repeat(state, [&](std::size_t i) { return sample_cosine_hemisphere(rays[i].direction, squares[i]); });
}

void camera(benchmark::State& state) {
    const Camera eye = make_camera({.from = {0, 1, 4}, .at = {0, 0, 0}}, 640, 400);
    repeat(state, [&](std::size_t i) { return camera_ray(eye, vec2(float(i), float(i % 400)) + 0.5f); });
}

void tree_build(benchmark::State& state) {
    const BenchScene scene = knot_field("", int(state.range(0)));
    for (auto _ : state) benchmark::DoNotOptimize(build_ours(scene.mesh, 1));
    state.SetItemsProcessed(state.iterations() * std::int64_t(scene.mesh.triangles.size()));
}

/// Random colours.
void flip_pictures(benchmark::State& state) {
    Random random(3);
    Image a(1024, 768), b(1024, 768);
    for (Image* image : {&a, &b})
        for (vec3& pixel : image->pixels) pixel = {random.uniform(), random.uniform(), random.uniform()};
    for (auto _ : state) benchmark::DoNotOptimize(rt::compare::flip(a, b).mean);
}

BENCHMARK(box)->Name("ray and box");
BENCHMARK(triangle)->Name("ray and triangle");
BENCHMARK(sphere)->Name("ray and sphere");
BENCHMARK(node_of_boxes)->Name("ray and the boxes of a node");
BENCHMARK(block_of_triangles)->Name("ray and a block of triangles");
BENCHMARK(block_of_spheres)->Name("ray and a block of spheres");
BENCHMARK(random_number)->Name("random number");
BENCHMARK(fresnel_term)->Name("Fresnel");
BENCHMARK(texture)->Name("texture, bilinear");
BENCHMARK(bounce)->Name("cosine direction");
BENCHMARK(camera)->Name("camera ray");
BENCHMARK(tree_build)->Name("tree of triangles")->Arg(10'000)->Arg(100'000)->Unit(benchmark::kMillisecond);
BENCHMARK(flip_pictures)->Name("FLIP, 1024 x 768")->Unit(benchmark::kMillisecond);

} // namespace

} // namespace rt::bench

int main(int argc, char** argv) {
    benchmark::Initialize(&argc, argv);
    if (argc > 1) {
        return rt::report_error("bench_kernels", std::string(argv[1]) + " is not known; --help says what is");
    }
    benchmark::RunSpecifiedBenchmarks();
    benchmark::Shutdown();
}
