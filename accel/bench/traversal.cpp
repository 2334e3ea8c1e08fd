// Measures how many rays per second the fast tree and Embree trace through a mesh: the same triangles, rays
// and threads, in turn. Also how long both builds take, and how much memory.
#include "accel/bench/agreement.h"
#include "accel/bench/sides.h"
#include "common/util/parallel.h"
#include "tools/bench/program.h"

#include <memory>

namespace rt::bench {
namespace {

struct Options {
    std::vector<std::string> meshes{"cat", "10k", "100k", "1M", "5M"};
    std::vector<std::string> rays{"primary", "bounce", "shadow"};
    std::vector<int> threads{1, 2};
    int rounds = 15, size = 512;
    int build_rounds = 0, checks = 0; ///< 0: by size
    std::string clock = "wall";
    bool without_embree = false;
};

const Options quick{
    .meshes = {"cat", "10k"}, .threads = {1}, .rounds = 3, .size = 128, .build_rounds = 3, .checks = 50};

struct Sides {
    std::unique_ptr<Ours> ours;
    std::unique_ptr<Embree> embree; ///< null if it is not measured
};

/// Builds both, in turn, several times, and keeps the last ones.
Sides build(const BenchScene& scene, int threads, const Options& options, Json& rows) {
    const std::size_t triangles = scene.triangles.size();
    const int by_size = triangles < 200'000 ? 15 : triangles < 2'000'000 ? 7 : 3;
    std::vector<double> ours_seconds, embree_seconds;
    Sides sides;
    for (int i = 0; i < (options.build_rounds > 0 ? options.build_rounds : by_size); ++i) {
        sides.ours.reset();
        sides.ours = std::make_unique<Ours>(scene.mesh(), threads);
        ours_seconds.push_back(sides.ours->cost.seconds);
        if (!RT_EMBREE || options.without_embree) continue;
        sides.embree.reset();
        sides.embree = std::make_unique<Embree>(scene.mesh(), threads);
        embree_seconds.push_back(sides.embree->cost.seconds);
    }
    const BuildCost ours = sides.ours->cost, embree = sides.embree ? sides.embree->cost : BuildCost{};
    const auto count = double(triangles), vertices = double(scene.vertices.size());
    rows.push_back({{"mesh", scene.name},
                    {"triangles", triangles},
                    {"threads", threads},
                    {"ours_seconds", median(ours_seconds)},
                    {"embree_seconds", median(embree_seconds)},
                    {"ratio", median(ours_seconds) / median(embree_seconds)},
                    {"mesh_bytes_per_triangle", sizeof(vec3) * (vertices + count) / count},
                    {"ours_bytes_per_triangle", ours.bytes / count},
                    {"ours_peak_bytes_per_triangle", ours.peak_bytes / count},
                    {"embree_bytes_per_triangle", embree.bytes / count},
                    {"embree_peak_bytes_per_triangle", embree.peak_bytes / count}});
    print_row(rows.back());
    return sides;
}

/// Traces the same rays on both sides, in turn. The first round warms up; the hits of the last are compared.
void measure(const BenchScene& scene, const Sides& sides, const std::string& kind,
             const std::vector<accel::Ray>& rays, int threads, const Options& options, Json& numbers) {
    const bool shadow = kind == "shadow";
    const auto million_per_second = [&](const auto& side, Hits& hits) {
        const Stopwatch watch;
        parallel_for(rays.size(), 1024, [&](std::size_t begin, std::size_t end) {
            side.trace({&rays[begin], &rays[end - 1] + 1}, &hits[begin], shadow);
        });
        return 1e-6 * double(rays.size()) / (options.clock == "cpu" ? watch.cpu() / threads : watch.wall());
    };
    Hits ours_hits(rays.size()), embree_hits(sides.embree ? rays.size() : 0);
    std::vector<double> ours, embree;
    for (int round = 0; round <= options.rounds; ++round) {
        if (round == 1) ours.clear(), embree.clear();
        ours.push_back(million_per_second(*sides.ours, ours_hits));
        if (sides.embree) embree.push_back(million_per_second(*sides.embree, embree_hits));
    }
    const auto triangles = int(scene.triangles.size());
    numbers["cases"].push_back({{"mesh", scene.name},
                                {"triangles", triangles},
                                {"rays", kind},
                                {"threads", threads},
                                {"ours_mrays", median(ours)},
                                {"embree_mrays", median(embree)},
                                {"ratio", median(ours) / median(embree)}});
    print_row(numbers["cases"].back());
    if (options.checks < 0) return;
    const int limit = options.checks > 0 ? options.checks : std::clamp(300'000'000 / triangles, 20, 300);
    numbers["checks"].push_back(compare(scene.mesh(), rays, ours_hits, embree_hits, shadow, limit));
    print_row(numbers["checks"].back());
}

Json measure(const Options& options) {
    const Json none = Json::array();
    Json numbers{{"cases", none}, {"geometric_mean_ratio", unknown}, {"build", none}, {"checks", none}};
    for (const std::string& name : options.meshes) {
        const BenchScene scene = make_scene(name);
        for (const int threads : options.threads) {
            set_thread_count(threads);
            const Sides sides = build(scene, threads, options, numbers["build"]);
            auto rays = make_rays(scene, sides.ours->bvh, std::max(16, options.size / 16 * 16));
            for (const std::string& kind : options.rays)
                measure(scene, sides, kind, rays[kind], threads, options, numbers);
        }
    }
    std::vector<double> ratios;
    for (const Json& row : numbers["cases"]) ratios.push_back(number(row, "ratio"));
    const double mean = geometric_mean(ratios);
    numbers["geometric_mean_ratio"] = mean;
    if (std::isfinite(mean)) std::printf("geometric mean of the ratios %.3f\n", mean);
    return numbers;
}

void declare(CLI::App& app, Options& options) {
    const auto set_quick = [&] { options = quick; }; // before the other options change it
    app.add_flag_callback("--quick", set_quick, "cat and 10k, few rays, 3 rounds: does it run?");
    app.add_option("--meshes", options.meshes, "cat, cow or numbers of triangles, as 10k,1M")->delimiter(',');
    add_choice(app, "--rays", options.rays, {"primary", "bounce", "shadow"},
               "kinds of rays, separated by commas");
    add_number(app, "--threads", options.threads, 1, 1024, "numbers of threads, separated by commas");
    add_number(app, "--rounds", options.rounds, 1, 10'000, "rounds of each side; the median counts");
    add_number(app, "--build-rounds", options.build_rounds, 0, 1000,
               "the same for builds; 0: 15 to 3, by size");
    add_number(app, "--size", options.size, 16, 4096, "side of the image in pixels, a multiple of 16");
    add_number(app, "--checks", options.checks, -1, 100'000,
               "rays judged by brute force; 0: 300 to 20, by size; -1: compare nothing");
    add_choice(app, "--clock", options.clock, {"wall", "cpu"}, "cpu: the mean processor time of the threads");
    app.add_flag("--without-embree", options.without_embree, "only our own columns");
}

} // namespace
} // namespace rt::bench

int main(int argc, char** argv) {
    rt::bench::Options options;
    CLI::App app("Traces the same rays with Raysteps and with Embree, and compares.", "bench_traversal");
    rt::bench::declare(app, options);
    return rt::bench::run_program(app, argc, argv, [&] { return rt::bench::measure(options); });
}
