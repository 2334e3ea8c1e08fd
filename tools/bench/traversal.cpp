// Measures how many rays per second are traced through a mesh by our tree and by Embree, side by side: the
// same triangles, the same rays, the same threads, in turn. Also how long both builds take, and how much
// memory.
#include "tools/bench/agreement.h"
#include "tools/bench/embree.h"
#include "tools/bench/memory.h"
#include "tools/bench/meshes.h"
#include "tools/bench/program.h"
#include "tools/bench/rays.h"
#include "tools/bench/statistics.h"
#include "tools/bench/threads.h"

#include <chrono>
#include <memory>
#include <optional>

namespace rt::bench {

struct TraversalOptions {
    std::vector<std::string> meshes{"cat", "10k", "100k", "1M", "5M"};
    std::vector<std::string> rays{"primary", "bounce", "shadow"};
    std::vector<int> threads{1, 2};
    int rounds = 15, size = 512;
    int build_rounds = 0, checks = 0; ///< 0: by size
    std::string clock = "wall", json;
    bool quick = false, without_embree = false;
};

struct Trees {
    std::optional<Ours> ours;
    std::unique_ptr<Embree> embree; ///< null if it is not measured
};

/// What is written: lists of rows.
struct Numbers {
    Json cases = Json::array(), builds = Json::array(), checks = Json::array();
    std::vector<double> ratios;
};

// ---- the builds ----

int build_rounds(const TraversalOptions& options, std::size_t triangles) {
    if (options.build_rounds > 0) return options.build_rounds;
    return triangles < 200'000 ? 15 : triangles < 2'000'000 ? 7 : 3;
}

/// Builds both, in turn, several times, and keeps the last ones.
Trees build_trees(const BenchScene& scene, int threads, const TraversalOptions& options, Json& builds) {
    const auto triangles = double(scene.mesh.triangles.size());
    std::vector<double> ours_seconds, embree_seconds;
    double bytes = 0, peak = 0;
    Trees trees;
    for (int i = 0; i < build_rounds(options, scene.mesh.triangles.size()); ++i) {
        trees.ours.reset();
        const std::int64_t before = peak_bytes = allocated_bytes.load();
        const auto start = std::chrono::steady_clock::now();
        trees.ours = build_ours(scene.mesh, threads);
        ours_seconds.push_back(
            std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
        bytes = double(allocated_bytes - before), peak = double(peak_bytes - before);
        if (!has_embree || options.without_embree) continue;
        trees.embree.reset();
        trees.embree = std::make_unique<Embree>(scene.mesh, threads);
        embree_seconds.push_back(trees.embree->seconds);
    }
    const double embree_bytes = trees.embree ? double(trees.embree->bytes) : unknown;
    const double embree_peak = trees.embree ? double(trees.embree->peak_bytes) : unknown;
    builds.push_back({{"mesh", scene.name},
                      {"triangles", scene.mesh.triangles.size()},
                      {"threads", threads},
                      {"ours_seconds", median(ours_seconds)},
                      {"embree_seconds", median(embree_seconds)},
                      {"ratio", median(ours_seconds) / median(embree_seconds)},
                      {"mesh_bytes_per_triangle", double(mesh_bytes(scene.mesh)) / triangles},
                      {"ours_bytes_per_triangle", bytes / triangles},
                      {"ours_peak_bytes_per_triangle", peak / triangles},
                      {"embree_bytes_per_triangle", embree_bytes / triangles},
                      {"embree_peak_bytes_per_triangle", embree_peak / triangles}});
    print_row(builds.back());
    return trees;
}

// ---- the rays ----

/// Traces the rays on one side. `Query` is what a thread needs for it.
template <typename Query, typename Side>
Seconds trace(int threads, const Side& side, const std::vector<Ray>& rays, bool shadow,
              std::vector<ClosestHit>& hits) {
    return run_threads(threads, rays.size(), [&](std::size_t begin, std::size_t end) {
        Query query(side);
        if (shadow)
            for (std::size_t i = begin; i < end; ++i)
                hits[i].primitive = any_hit(query, rays[i]) ? 0 : no_primitive;
        else
            for (std::size_t i = begin; i < end; ++i) hits[i] = closest_hit(query, rays[i]);
    });
}

/// Traces the same rays on both sides, in turn; the first round warms up, and the last one gives the hits to
/// compare.
void measure(const BenchScene& scene, const Trees& trees, const std::string& kind,
             const std::vector<Ray>& rays, int threads, const TraversalOptions& options, Numbers& numbers) {
    const bool shadow = kind == "shadow";
    std::vector<ClosestHit> ours(rays.size()), embree(trees.embree ? rays.size() : 0);
    std::vector<double> ours_mrays, embree_mrays;
    const auto add_rate = [&](std::vector<double>& rates, const Seconds& seconds) {
        rates.push_back(1e-6 * double(rays.size()) / (options.clock == "cpu" ? seconds.cpu : seconds.wall));
    };
    for (int round = 0; round <= options.rounds; ++round) {
        if (round == 1) ours_mrays.clear(), embree_mrays.clear();
        add_rate(ours_mrays, trace<const Ours&>(threads, *trees.ours, rays, shadow, ours));
        if (trees.embree)
            add_rate(embree_mrays, trace<EmbreeQuery>(threads, *trees.embree, rays, shadow, embree));
    }
    numbers.ratios.push_back(median(ours_mrays) / median(embree_mrays));
    numbers.cases.push_back({{"mesh", scene.name},
                             {"triangles", scene.mesh.triangles.size()},
                             {"rays", kind},
                             {"threads", threads},
                             {"ours_mrays", median(ours_mrays)},
                             {"embree_mrays", median(embree_mrays)},
                             {"ratio", numbers.ratios.back()}});
    print_row(numbers.cases.back());
    if (options.checks < 0) return;
    const auto by_size = int(std::clamp<std::size_t>(300'000'000 / scene.mesh.triangles.size(), 20, 300));
    const int limit = options.checks > 0 ? options.checks : by_size;
    numbers.checks.push_back(json(compare(scene.mesh, rays, ours, embree, shadow, limit)));
    std::printf("    ");
    print_row(numbers.checks.back());
}

void measure(const BenchScene& scene, const TraversalOptions& options, Numbers& numbers) {
    std::optional<RaySets> sets; // the same for any number of threads
    for (const int threads : options.threads) {
        const Trees trees = build_trees(scene, threads, options, numbers.builds);
        if (!sets) sets = make_rays(scene, *trees.ours, options.size);
        for (const std::string& kind : options.rays)
            measure(scene, trees, kind,
                    kind == "shadow"   ? sets->shadow
                    : kind == "bounce" ? sets->bounce
                                       : sets->primary,
                    threads, options, numbers);
    }
}

void run(const TraversalOptions& options) {
    check_json(options.json);
    Numbers numbers;
    for (const std::string& name : options.meshes) measure(make_scene(name), options, numbers);
    const double mean = geometric_mean(numbers.ratios);
    if (std::isfinite(mean)) std::printf("geometric mean of the ratios %.3f\n", mean);
    write_json(options.json, {{"cases", numbers.cases},
                              {"geometric_mean_ratio", mean},
                              {"build", numbers.builds},
                              {"checks", numbers.checks}});
}

void declare(CLI::App& app, TraversalOptions& options) {
    app.add_option("--meshes", options.meshes,
                   "cat, cow or numbers of triangles (10k, 1M), separated by commas")
        ->delimiter(',');
    app.add_option("--rays", options.rays, "primary, bounce, shadow")
        ->delimiter(',')
        ->check(CLI::IsMember({"primary", "bounce", "shadow"}));
    app.add_option("--threads", options.threads, "numbers of threads")
        ->delimiter(',')
        ->check(CLI::Range(1, 1024));
    app.add_option("--rounds", options.rounds, "rounds of each side; the median counts")
        ->check(CLI::Range(1, 10000));
    app.add_option("--build-rounds", options.build_rounds, "the same for the builds; 0: 15 to 3, by size")
        ->check(CLI::Range(0, 1000));
    app.add_option("--size", options.size, "side of the picture whose rays are traced, a multiple of 16")
        ->check(CLI::Range(16, 4096));
    app.add_option("--checks", options.checks,
                   "rays judged by brute force; 0: 300 to 20, by size; -1: compare nothing")
        ->check(CLI::Range(-1, 100'000));
    app.add_option("--clock", options.clock, "wall, or cpu for the mean processor time of the threads")
        ->check(CLI::IsMember({"wall", "cpu"}));
    app.add_flag("--quick", options.quick, "cat and 10k, few rays, 3 rounds: does it run?");
    app.add_flag("--without-embree", options.without_embree, "only our own columns");
    add_json_option(app, options.json);
}

void apply_quick(const CLI::App& app, TraversalOptions& options) {
    set_by_default(app, "--meshes", options.meshes, std::vector<std::string>{"cat", "10k"});
    set_by_default(app, "--threads", options.threads, std::vector<int>{1});
    set_by_default(app, "--rounds", options.rounds, 3);
    set_by_default(app, "--build-rounds", options.build_rounds, 3);
    set_by_default(app, "--size", options.size, 128);
    set_by_default(app, "--checks", options.checks, 50);
}

} // namespace rt::bench

int main(int argc, char** argv) {
    rt::bench::TraversalOptions options;
    CLI::App app("Traces the same rays with Raysteps and with Embree, and compares.", "bench_traversal");
    rt::bench::declare(app, options);
    return rt::bench::run_program(app, argc, argv, [&] {
        if (options.quick) rt::bench::apply_quick(app, options);
        options.size = std::max(16, options.size / 16 * 16);
        rt::bench::run(options);
    });
}
