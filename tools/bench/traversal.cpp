// How many rays a second find their way through a mesh, ours and Embree's side by side: the same triangles,
// the same rays, the same threads, round about. Also how long both builds take, and what they hold.
#include "tools/bench/agreement.h"
#include "tools/bench/embree.h"
#include "common/util/report_error.h"
#include "common/util/json.h"
#include "tools/bench/memory.h"
#include "tools/bench/meshes.h"
#include "tools/bench/ours.h"
#include "tools/bench/rays.h"
#include "tools/bench/statistics.h"
#include "tools/bench/team.h"

#include <CLI/CLI.hpp>

#include <chrono>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace rt::bench {

struct Wish {
    std::vector<std::string> meshes{"cat", "10k", "100k", "1M", "5M"};
    std::vector<std::string> rays{"primary", "bounce", "shadow"};
    std::vector<int> threads{1, 2};
    int rounds = 15;
    int build_rounds = 0; ///< 0: by size
    int size = 512;
    int checks = 0; ///< 0: by size
    std::string quality = "medium", clock = "wall", json;
    bool quick = false, without_embree = false;
};

#if RT_EMBREE
using Other = std::unique_ptr<Embree>; ///< null if not asked for
#else
struct Nobody {
    double seconds = 0;
    std::int64_t bytes = 0, peak_bytes = 0;
};
using Other = std::unique_ptr<Nobody>; ///< always null
#endif

struct Build {
    double ours_seconds = unknown, embree_seconds = unknown;
    std::int64_t ours_bytes = 0, ours_peak = 0;
    double embree_bytes = unknown, embree_peak = unknown;
};

struct Case {
    double ours_mrays = unknown, embree_mrays = unknown, ratio = unknown;
    Agreement agreement;
};

// ---- the builds ----

Ours timed_build(const Mesh& mesh, int threads, std::vector<double>& seconds, Build& build) {
    const std::int64_t before = allocated();
    peak_allocated(true);
    const auto start = std::chrono::steady_clock::now();
    Ours ours = build_ours(mesh, threads);
    seconds.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    build.ours_bytes = allocated() - before;
    build.ours_peak = peak_allocated(false) - before;
    return ours;
}

Other timed_embree([[maybe_unused]] const Mesh& mesh, [[maybe_unused]] int threads, const Wish& wish,
                   [[maybe_unused]] std::vector<double>& seconds) {
    if (wish.without_embree) return nullptr;
#if RT_EMBREE
    const Quality quality = wish.quality == "high"     ? Quality::high
                            : wish.quality == "robust" ? Quality::robust
                                                       : Quality::medium;
    auto embree = std::make_unique<Embree>(mesh, threads, quality);
    seconds.push_back(embree->seconds);
    return embree;
#else
    return nullptr;
#endif
}

struct Sides {
    Ours ours;
    Other embree;
};

/// Builds both, round about, several times; keeps the last ones.
Sides build_both(const Mesh& mesh, int threads, const Wish& wish, Build& build) {
    const std::size_t triangles = mesh.triangles.size();
    const int rounds = wish.build_rounds > 0   ? wish.build_rounds
                       : triangles < 200'000   ? 15
                       : triangles < 2'000'000 ? 7
                                               : 3;
    std::vector<double> ours_seconds, embree_seconds;
    std::optional<Ours> ours;
    Other embree;
    for (int i = 0; i < rounds; ++i) {
        ours.reset();
        ours = timed_build(mesh, threads, ours_seconds, build);
        embree.reset();
        embree = timed_embree(mesh, threads, wish, embree_seconds);
    }
    build.ours_seconds = median(ours_seconds);
    build.embree_seconds = median(embree_seconds);
    if (embree) {
        build.embree_bytes = double(embree->bytes);
        build.embree_peak = double(embree->peak_bytes);
    }
    return {std::move(*ours), std::move(embree)};
}

// ---- the rays ----

Seconds trace_ours(Team& team, const Ours& ours, const std::vector<Ray>& rays, bool segment,
                   std::vector<Found>& answers) {
    if (segment)
        return team.run(rays.size(), [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i)
                answers[i].primitive = any_hit(ours, rays[i]) ? 0 : nothing;
        });
    return team.run(rays.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) answers[i] = nearest(ours, rays[i]);
    });
}

#if RT_EMBREE
Seconds trace_embree(Team& team, const Embree& embree, const std::vector<Ray>& rays, bool segment,
                     std::vector<Found>& answers) {
    RTCIntersectContext shared;
    rtcInitIntersectContext(&shared);
    if (segment)
        return team.run(rays.size(), [&](std::size_t begin, std::size_t end) {
            const FlushDenormals flush;
            RTCIntersectContext context = shared;
            for (std::size_t i = begin; i < end; ++i)
                answers[i].primitive = any_hit(embree, context, rays[i]) ? 0 : nothing;
        });
    return team.run(rays.size(), [&](std::size_t begin, std::size_t end) {
        const FlushDenormals flush;
        RTCIntersectContext context = shared;
        for (std::size_t i = begin; i < end; ++i) answers[i] = nearest(embree, context, rays[i]);
    });
}
#else
Seconds trace_embree(Team&, const Nobody&, const std::vector<Ray>&, bool, std::vector<Found>&) {
    return {};
}
#endif

/// Traces the same rays on both sides, round about; the first round warms up and gives the answers to
/// compare.
Case measure(Team& team, const Mesh& mesh, const Sides& sides, const std::vector<Ray>& rays, bool segment,
             const Wish& wish) {
    std::vector<Found> ours(rays.size()), embree(sides.embree ? rays.size() : 0);
    std::vector<double> ours_mrays, embree_mrays, ratios;
    for (int round = 0; round <= wish.rounds; ++round) {
        const auto rate = [&](const Seconds& seconds) {
            return 1e-6 * double(rays.size()) / (wish.clock == "cpu" ? seconds.cpu : seconds.wall);
        };
        const double a = rate(trace_ours(team, sides.ours, rays, segment, ours));
        if (round > 0) ours_mrays.push_back(a);
        if (!sides.embree) continue;
        const double b = rate(trace_embree(team, *sides.embree, rays, segment, embree));
        if (round > 0) embree_mrays.push_back(b);
    }
    Case result;
    result.ours_mrays = median(ours_mrays);
    result.embree_mrays = median(embree_mrays);
    result.ratio = result.ours_mrays / result.embree_mrays;
    const int limit = wish.checks > 0
                          ? wish.checks
                          : int(std::clamp<std::size_t>(300'000'000 / mesh.triangles.size(), 20, 300));
    if (wish.checks >= 0) result.agreement = compare(mesh, rays, ours, embree, segment, limit);
    return result;
}

// ---- the report ----

struct Report {
    std::vector<std::string> cases, builds, checks;
    std::vector<double> ratios;
};

void print(const char* pattern, auto... values) {
    std::printf(pattern, values...);
    std::fflush(stdout);
}

/// A dash for what was not measured.
std::string shown(const char* pattern, double value) {
    if (!std::isfinite(value)) return "-";
    char text[64];
    std::snprintf(text, sizeof text, pattern, value);
    return text;
}

void add_build(Report& report, const Subject& subject, int threads, const Build& build) {
    const auto triangles = double(subject.mesh.triangles.size());
    const auto each = [&](double bytes) { return json::number(bytes / triangles); };
    const auto mesh = double(mesh_bytes(subject.mesh));
    print("%-6s %9.0f  %-8s %d thread%s  ours %8.1f ms, Embree %s ms, ours/Embree %s   bytes a triangle: "
          "ours %.1f "
          "(peak %.1f), mesh %.1f, Embree %s (peak %s)\n",
          subject.name.c_str(), triangles, "build", threads, threads > 1 ? "s" : " ",
          1e3 * build.ours_seconds, shown("%8.1f", 1e3 * build.embree_seconds).c_str(),
          shown("%5.2f", build.ours_seconds / build.embree_seconds).c_str(),
          double(build.ours_bytes) / triangles, double(build.ours_peak) / triangles, mesh / triangles,
          shown("%.1f", build.embree_bytes / triangles).c_str(),
          shown("%.1f", build.embree_peak / triangles).c_str());
    report.builds.push_back(json::object({{"mesh", json::text(subject.name)},
                                          {"triangles", json::number(std::int64_t(triangles))},
                                          {"threads", json::number(std::int64_t(threads))},
                                          {"ours_seconds", json::number(build.ours_seconds)},
                                          {"embree_seconds", json::number(build.embree_seconds)},
                                          {"ratio", json::number(build.ours_seconds / build.embree_seconds)},
                                          {"ours_bytes_per_triangle", each(double(build.ours_bytes))},
                                          {"mesh_bytes_per_triangle", each(mesh)},
                                          {"ours_peak_bytes_per_triangle", each(double(build.ours_peak))},
                                          {"embree_bytes_per_triangle", each(build.embree_bytes)},
                                          {"embree_peak_bytes_per_triangle", each(build.embree_peak)}}));
}

void add_case(Report& report, const Subject& subject, const std::string& rays, int threads,
              const Case& result) {
    const auto triangles = std::int64_t(subject.mesh.triangles.size());
    const Agreement& a = result.agreement;
    print("%-6s %9lld  %-8s %d thread%s  ours %8.2f, Embree %s Mrays/s, ratio %s   %lld of %lld disagree",
          subject.name.c_str(), static_cast<long long>(triangles), rays.c_str(), threads,
          threads > 1 ? "s" : " ", result.ours_mrays, shown("%8.2f", result.embree_mrays).c_str(),
          shown("%5.2f", result.ratio).c_str(), static_cast<long long>(disagreements(a)),
          static_cast<long long>(a.rays));
    if (disagreements(a) > 0)
        print(" (only ours hits %d, only Embree %d, ours nearer %d, Embree nearer %d; of %d judged ours "
              "right %d, "
              "Embree right %d)",
              int(a.only_ours), int(a.only_embree), int(a.ours_nearer), int(a.embree_nearer), int(a.judged),
              int(a.ours_right), int(a.embree_right));
    print("; brute force: %d of %d wrong\n", int(a.sampled_wrong), int(a.sampled));
    report.ratios.push_back(result.ratio);
    const json::Fields head{{"mesh", json::text(subject.name)},
                            {"triangles", json::number(triangles)},
                            {"rays", json::text(rays)},
                            {"threads", json::number(std::int64_t(threads))}};
    json::Fields rates = head, checks{head[0], head[2], head[3]};
    rates.push_back({"ours_mrays", json::number(result.ours_mrays)});
    rates.push_back({"embree_mrays", json::number(result.embree_mrays)});
    rates.push_back({"ratio", json::number(result.ratio)});
    report.cases.push_back(json::object(rates));
    for (const auto& field : fields(a))
        checks.push_back({field.first == "rays" ? "count" : field.first, field.second});
    report.checks.push_back(json::object(checks));
}

void run_subject(const Subject& subject, const Wish& wish, Report& report) {
    std::optional<RaySets> sets; // the same for any number of threads
    for (const int threads : wish.threads) {
        Build build;
        const Sides sides = build_both(subject.mesh, threads, wish, build);
        add_build(report, subject, threads, build);
        if (!sets) sets = make_rays(subject, sides.ours, wish.size);
        Team team(threads);
        for (const std::string& kind : wish.rays) {
            const bool segment = kind == "shadow";
            const auto& rays = segment ? sets->shadow : kind == "bounce" ? sets->bounce : sets->primary;
            add_case(report, subject, kind, threads, measure(team, subject.mesh, sides, rays, segment, wish));
        }
    }
}

void run(const Wish& wish) {
    json::check_writable(wish.json);
    Report report;
    for (const std::string& name : wish.meshes) run_subject(make_subject(name), wish, report);
    const double mean = geometric_mean(report.ratios);
    if (std::isfinite(mean)) print("geometric mean of the ratios %.3f\n", mean);
    json::write(wish.json, json::object({{"cases", json::array(report.cases)},
                                         {"geometric_mean_ratio", json::number(mean)},
                                         {"build", json::array(report.builds)},
                                         {"checks", json::array(report.checks)}}));
}

void declare(CLI::App& app, Wish& wish) {
    app.add_option("--meshes", wish.meshes, "cat, cow or numbers of triangles (10k, 1M), separated by commas")
        ->delimiter(',');
    app.add_option("--rays", wish.rays, "primary, bounce, shadow")
        ->delimiter(',')
        ->check(CLI::IsMember({"primary", "bounce", "shadow"}));
    app.add_option("--threads", wish.threads, "numbers of threads")
        ->delimiter(',')
        ->check(CLI::Range(1, 1024));
    app.add_option("--rounds", wish.rounds, "rounds of each side, of which the median counts")
        ->check(CLI::Range(1, 10000));
    app.add_option("--build-rounds", wish.build_rounds, "the same for the builds; 0: 15 to 3, by size")
        ->check(CLI::Range(0, 1000));
    app.add_option("--size", wish.size, "side of the picture whose rays are traced, a multiple of 16")
        ->check(CLI::Range(16, 4096));
    app.add_option("--checks", wish.checks,
                   "rays put to every triangle; 0: 300 to 20, by size; -1: compare nothing")
        ->check(CLI::Range(-1, 100'000));
    app.add_option("--quality", wish.quality, "Embree's: medium, high or robust")
        ->check(CLI::IsMember({"medium", "high", "robust"}));
    app.add_option("--clock", wish.clock, "wall, or cpu for the mean of the threads' processor time")
        ->check(CLI::IsMember({"wall", "cpu"}));
    app.add_option("--json", wish.json, "a file for the numbers");
    app.add_flag("--quick", wish.quick, "cat and 10k, few rays, 3 rounds: does it run?");
    app.add_flag("--without-embree", wish.without_embree, "only our own columns");
}

void settle(CLI::App& app, Wish& wish) {
    wish.size = std::max(16, wish.size / 16 * 16);
    if (!wish.quick) return;
    const auto unless = [&](const char* flag, auto& value, auto quick) {
        if (app.count(flag) == 0) value = quick;
    };
    unless("--meshes", wish.meshes, std::vector<std::string>{"cat", "10k"});
    unless("--threads", wish.threads, std::vector<int>{1});
    unless("--rounds", wish.rounds, 3);
    unless("--build-rounds", wish.build_rounds, 3);
    unless("--size", wish.size, 128);
    unless("--checks", wish.checks, 50);
}

} // namespace rt::bench

int main(int argc, char** argv) {
    rt::bench::Wish wish;
    CLI::App app("Traces the same rays with Raysteps and with Embree, and compares.", "bench_traversal");
    rt::bench::declare(app, wish);
    try {
        app.parse(argc, argv);
        rt::bench::settle(app, wish);
        rt::bench::run(wish);
        return 0;
    } catch (const CLI::CallForHelp& help) {
        return app.exit(help);
    } catch (const std::exception& problem) {
        return rt::report_error("bench_traversal", problem.what());
    }
}
