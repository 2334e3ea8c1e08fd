// bench_report FOLDER: turns the numbers of traversal.json, scaling.json, ... in a folder into report.md and
// plots.
#include "common/util/report_error.h"
#include "common/util/error.h"
#include "common/util/json.h"
#include "tools/bench/json_reader.h"
#include "tools/bench/statistics.h"
#include "tools/bench/svg.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

namespace rt::bench {

namespace fs = std::filesystem;

// ---- Markdown ----

struct Table {
    std::vector<std::string> head;
    std::vector<std::vector<std::string>> rows;
};

/// Columns of equal width, so that the file reads well as it stands; all but the first few are numbers, to
/// the right.
std::string markdown(const Table& table, std::size_t names) {
    std::vector<std::size_t> widths;
    for (const std::string& title : table.head) widths.push_back(title.size());
    for (const auto& row : table.rows)
        for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
    const auto line = [&](const std::vector<std::string>& cells) {
        std::string out = "|";
        for (std::size_t i = 0; i < widths.size(); ++i) {
            const std::string air(widths[i] - cells[i].size(), ' ');
            out += " " + (i < names ? cells[i] + air : air + cells[i]) + " |";
        }
        return out + "\n";
    };
    std::string out = line(table.head) + "|";
    for (std::size_t i = 0; i < widths.size(); ++i)
        out += std::string(widths[i] + 1, '-') + (i < names ? "-|" : ":|");
    out += "\n";
    for (const auto& row : table.rows) out += line(row);
    return out + "\n";
}

std::string fixed(double value, int digits) {
    if (!std::isfinite(value)) return "-";
    char text[64];
    std::snprintf(text, sizeof text, "%.*f", digits, value);
    return text;
}

std::string cell(const Json& value) {
    if (value.kind == Json::Kind::text) return value.text;
    if (value.kind == Json::Kind::boolean) return value.number != 0 ? "yes" : "no";
    if (value.kind != Json::Kind::number) return "-";
    return json::number(value.number);
}

// ---- the folder ----

struct Report {
    fs::path folder;
    std::string text;

    void plot(const std::string& name, const auto& what) {
        json::write((folder / name).string(), svg(what));
        text += "![" + what.title + "](" + name + ")\n\n";
    }
};

/// What a benchmark wrote, if it ran.
std::optional<Json> read(const fs::path& file) {
    std::ifstream stream(file);
    if (!stream) return std::nullopt;
    std::ostringstream all;
    all << stream.rdbuf();
    try {
        return parse_json(all.str());
    } catch (const Error& problem) {
        throw Error(file.string() + ": " + problem.what());
    }
}

double value(const Json& object, const char* name) {
    return number_of(field(object, name));
}

std::string text_of(const Json& object, const char* name) {
    return field(object, name).text;
}

// ---- traversal ----

Table build_table(const Json& json) {
    Table table{{"mesh", "triangles", "threads", "ours ms", "Embree ms", "ours/Embree", "ours bytes",
                 "its peak", "mesh bytes", "Embree bytes", "its peak"},
                {}};
    for (const Json& build : field(json, "build").list)
        table.rows.push_back({text_of(build, "mesh"), fixed(value(build, "triangles"), 0),
                              fixed(value(build, "threads"), 0), fixed(1e3 * value(build, "ours_seconds"), 1),
                              fixed(1e3 * value(build, "embree_seconds"), 1), fixed(value(build, "ratio"), 2),
                              fixed(value(build, "ours_bytes_per_triangle"), 1),
                              fixed(value(build, "ours_peak_bytes_per_triangle"), 1),
                              fixed(value(build, "mesh_bytes_per_triangle"), 1),
                              fixed(value(build, "embree_bytes_per_triangle"), 1),
                              fixed(value(build, "embree_peak_bytes_per_triangle"), 1)});
    return table;
}

Table case_table(const Json& json) {
    Table table{{"mesh", "rays", "triangles", "threads", "ours Mrays/s", "Embree Mrays/s", "ratio"}, {}};
    for (const Json& one : field(json, "cases").list)
        table.rows.push_back({text_of(one, "mesh"), text_of(one, "rays"), fixed(value(one, "triangles"), 0),
                              fixed(value(one, "threads"), 0), fixed(value(one, "ours_mrays"), 2),
                              fixed(value(one, "embree_mrays"), 2), fixed(value(one, "ratio"), 2)});
    return table;
}

/// Where the two sides did not find the same.
std::string check_summary(const Json& json) {
    double rays = 0, differ = 0, judged = 0, ours = 0, embree = 0, sampled = 0, wrong = 0;
    for (const Json& check : field(json, "checks").list) {
        rays += value(check, "count");
        for (const char* kind : {"only_ours_hits", "only_embree_hits", "ours_nearer", "embree_nearer"})
            differ += value(check, kind);
        judged += value(check, "judged_by_brute_force");
        ours += value(check, "ours_right");
        embree += value(check, "embree_right");
        sampled += value(check, "sampled_against_brute_force");
        wrong += value(check, "ours_wrong_among_sampled");
    }
    return "Of " + fixed(rays, 0) + " rays " + fixed(differ, 0) + " disagree; of " + fixed(judged, 0) +
           " of these, put to every triangle, ours is right in " + fixed(ours, 0) + " and Embree in " +
           fixed(embree, 0) + ". Of " + fixed(sampled, 0) + " rays picked at random ours is wrong in " +
           fixed(wrong, 0) + ".\n\n";
}

/// The values of `what` by mesh and kind of ray, for one number of threads.
Bars case_bars(const Json& json, double threads, const char* what) {
    Bars bars;
    const auto place = [](std::vector<std::string>& names, const std::string& name) {
        const auto found = std::ranges::find(names, name);
        if (found == names.end()) return names.push_back(name), names.size() - 1;
        return std::size_t(found - names.begin());
    };
    for (const Json& one : field(json, "cases").list) {
        if (value(one, "threads") != threads) continue;
        const std::size_t group = place(bars.groups, text_of(one, "mesh"));
        const std::size_t series = place(bars.series, text_of(one, "rays"));
        bars.values.resize(std::max(bars.values.size(), group + 1));
        for (auto& row : bars.values) row.resize(std::max(bars.series.size(), row.size()), unknown);
        bars.values[group][series] = value(one, what);
    }
    for (auto& row : bars.values) row.resize(bars.series.size(), unknown);
    return bars;
}

std::vector<double> thread_counts(const Json& json) {
    std::vector<double> counts;
    for (const Json& one : field(json, "cases").list)
        if (std::ranges::find(counts, value(one, "threads")) == counts.end())
            counts.push_back(value(one, "threads"));
    return counts;
}

void add_traversal(Report& report, const Json& json) {
    report.text +=
        "## Traversal\n\nThe same rays through the same triangles, ours and Embree's side by side.\n\n" +
        markdown(case_table(json), 2);
    const bool both = std::isfinite(value(json, "geometric_mean_ratio"));
    if (both)
        report.text +=
            "Geometric mean of the ratios: " + fixed(value(json, "geometric_mean_ratio"), 2) + ".\n\n";
    report.text += check_summary(json);
    for (const double threads : thread_counts(json)) {
        Bars bars = case_bars(json, threads, both ? "ratio" : "ours_mrays");
        const std::string count = fixed(threads, 0) + (threads > 1 ? " threads" : " thread");
        bars.title = (both ? "Rays a second, ours over Embree's, " : "Rays a second, ") + count;
        bars.y_label = both ? "ratio" : "million rays a second";
        bars.reference = both ? 1 : 0;
        report.plot("traversal_" + fixed(threads, 0) + ".svg", bars);
    }
    report.text += "### Build\n\nBytes are those of a triangle.\n\n" + markdown(build_table(json), 1);
}

// ---- scaling ----

/// y over the number of triangles, from the list `list` of the report; of one kind of ray, or all if it is
/// empty.
Curve curve(const Json& json, const char* list, const std::string& rays, const auto& y) {
    Curve result;
    for (const Json& one : field(json, list).list)
        if (rays.empty() || text_of(one, "rays") == rays)
            result.points.emplace_back(value(one, "triangles"), y(one));
    return result;
}

LogPlot sides_plot(const Json& json, const std::string& title, const std::string& y_label,
                   const std::vector<std::pair<std::string, const char*>>& curves, double scale) {
    LogPlot plot{title, "triangles", y_label, {}};
    for (std::size_t i = 0; i < curves.size(); ++i) {
        plot.curves.push_back(
            curve(json, "build", "", [&](const Json& one) { return scale * value(one, curves[i].second); }));
        plot.curves.back().name = curves[i].first;
        plot.curves.back().colour = int(i % (curves.size() / 2)); // of a quantity, for both sides
        plot.curves.back().dashed = curves[i].first.starts_with("Embree");
    }
    return plot;
}

void add_scaling(Report& report, const Json& json) {
    report.text += "## Scaling\n\nOne thread, from few triangles to many.\n\n";
    LogPlot times{"Time a ray", "triangles", "nanoseconds", {}};
    int colour = 0;
    for (const char* rays : {"primary", "bounce", "shadow"}) {
        for (const bool embree : {false, true}) {
            Curve one = curve(json, "cases", rays, [&](const Json& at) {
                return 1e3 / value(at, embree ? "embree_mrays" : "ours_mrays");
            });
            one.name = std::string(embree ? "Embree, " : "ours, ") + rays;
            one.colour = colour;
            one.dashed = embree;
            times.curves.push_back(one);
        }
        ++colour;
    }
    report.plot("scaling_ray.svg", times);
    report.plot("scaling_build.svg",
                sides_plot(json, "Time to build", "milliseconds",
                           {{"ours", "ours_seconds"}, {"Embree", "embree_seconds"}}, 1e3));
    report.plot("scaling_memory.svg",
                sides_plot(json, "Memory of the tree, without the mesh", "bytes a triangle",
                           {{"ours", "ours_bytes_per_triangle"},
                            {"ours, peak of the build", "ours_peak_bytes_per_triangle"},
                            {"Embree", "embree_bytes_per_triangle"},
                            {"Embree, peak of the build", "embree_peak_bytes_per_triangle"}},
                           1));
    report.text += markdown(case_table(json), 2) + markdown(build_table(json), 1);
}

// ---- renders ----

void add_renders(Report& report, const Json& json) {
    Table table{{"step", "s in all", "s rendering", "rays", "Mrays/s", "scene %", "build %", "traversal %",
                 "shading %"},
                {}};
    Shares shares{
        "Where one thread's time goes", {}, {"scene and files", "tree", "traversal", "shading"}, {}};
    for (const Json& one : field(json, "renders").list) {
        table.rows.push_back({text_of(one, "step"), fixed(value(one, "seconds"), 2),
                              fixed(value(one, "render_seconds"), 2), fixed(value(one, "rays"), 0),
                              fixed(value(one, "mrays_per_second"), 2)});
        shares.rows.push_back(text_of(one, "step"));
        shares.values.emplace_back();
        for (const char* share : {"scene_share", "build_share", "traversal_share", "shading_share"}) {
            table.rows.back().push_back(fixed(100 * value(one, share), 1));
            shares.values.back().push_back(value(one, share));
        }
    }
    report.text +=
        "## Renders\n\nEach step's reference picture. The shares are those of one thread, up to the last "
        "ray: a second thread looks 20,000 times a second whether the program makes its scene, builds its "
        "trees, searches for what a ray meets, or does anything else.\n\n" +
        markdown(table, 1);
    report.plot("renders.svg", shares);
}

// ---- kernels, and whatever else is a list ----

/// Three digits, and the unit that suits.
std::string duration(double nanoseconds) {
    if (!(nanoseconds >= 0)) return "-";
    const bool large = nanoseconds >= 1e5;
    const double value = large ? nanoseconds * 1e-6 : nanoseconds;
    return fixed(value, value < 10 ? 2 : value < 100 ? 1 : 0) + (large ? " ms" : " ns");
}

void add_kernels(Report& report, const Json& json) {
    Table table{{"kernel", "time a call", "million items/s"}, {}};
    for (const Json& one : field(json, "benchmarks").list) {
        const std::string unit = text_of(one, "time_unit");
        const double scale = unit == "ms" ? 1e6 : unit == "us" ? 1e3 : unit == "s" ? 1e9 : 1;
        table.rows.push_back({text_of(one, "name"), duration(scale * value(one, "cpu_time")),
                              fixed(1e-6 * value(one, "items_per_second"), 1)});
    }
    report.text += "## Kernels\n\nEach alone, its data in the cache. A tree's items are triangles.\n\n" +
                   markdown(table, 1);
}

Table any_table(const std::vector<Json>& list) {
    Table table;
    table.head = list[0].names;
    for (const Json& row : list) {
        table.rows.emplace_back();
        for (const std::string& name : table.head) table.rows.back().push_back(cell(field(row, name)));
    }
    return table;
}

void add_any(Report& report, const std::string& name, const std::string& title, const Json& json) {
    report.text += "## " + title + "\n\n";
    for (std::size_t i = 0; i < json.names.size(); ++i) {
        const Json& one = json.list[i];
        const std::vector<Json> rows = one.kind == Json::Kind::fields ? std::vector<Json>(1, one) : one.list;
        if (rows.empty() || rows[0].names.empty()) continue;
        report.text += markdown(any_table(rows), 0);
    }
    std::vector<std::string> plots; // that the benchmark has drawn itself
    for (const auto& file : fs::directory_iterator(report.folder)) {
        const std::string plot = file.path().filename().string();
        if (plot.starts_with(name + "_") && plot.ends_with(".svg")) plots.push_back(plot);
    }
    std::ranges::sort(plots);
    for (const std::string& plot : plots) report.text += "![" + title + "](" + plot + ")\n\n";
}

// ---- all ----

std::string machine() {
    std::ifstream cpu("/proc/cpuinfo");
    std::string name = "a machine";
    for (std::string line; std::getline(cpu, line);)
        if (line.starts_with("model name")) {
            name = line.substr(std::min(line.find(": "), line.size() - 2) + 2);
            break;
        }
    return "Measured on " + name + ", " + std::to_string(std::thread::hardware_concurrency()) +
           " hardware threads, compiled by " RT_COMPILER ".\n\n";
}

void run(const fs::path& folder) {
    Report report{folder, "# Benchmarks\n\n" + machine()};
    if (const auto json = read(folder / "traversal.json")) add_traversal(report, *json);
    if (const auto json = read(folder / "scaling.json")) add_scaling(report, *json);
    if (const auto json = read(folder / "renders.json")) add_renders(report, *json);
    if (const auto json = read(folder / "convergence.json"))
        add_any(report, "convergence", "Convergence", *json);
    if (const auto json = read(folder / "obj.json")) add_any(report, "obj", "Loading an OBJ file", *json);
    if (const auto json = read(folder / "kernels.json")) add_kernels(report, *json);
    while (report.text.ends_with('\n')) report.text.pop_back();
    json::write((folder / "report.md").string(), report.text);
}

} // namespace rt::bench

int main(int argc, char** argv) {
    std::string folder;
    CLI::App app("Writes report.md and plots from the numbers in a folder.", "bench_report");
    app.add_option("folder", folder, "where traversal.json and the others are")
        ->required()
        ->check(CLI::ExistingDirectory);
    try {
        app.parse(argc, argv);
        rt::bench::run(folder);
        return 0;
    } catch (const CLI::CallForHelp& help) {
        return app.exit(help);
    } catch (const std::exception& problem) {
        return rt::report_error("bench_report", problem.what());
    }
}
