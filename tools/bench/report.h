// The report on the numbers that the benchmarks write: its text in Markdown, and the data of its plots.
#pragma once

#include "common/util/error.h"
#include "tools/bench/numbers.h"

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace rt::bench {

struct Report {
    bool with_plots = true;
    std::string text;
    std::map<std::string, std::string> plots; ///< by name, in the format of tools/figures/plot.gp
};

// ---- plots ----

/// Returns a text in quotes for gnuplot, without the characters that mean something to it.
inline std::string quoted(std::string text) {
    std::erase_if(text, [](char c) { return c == '"' || c == '\\' || c == '`' || (c >= 0 && c < ' '); });
    return "\"" + text + "\"";
}

inline void add_plot(Report& report, const std::string& name, const std::string& title,
                     const std::string& settings, const std::string& data) {
    if (!report.with_plots || data.empty()) return;
    report.plots[name] = "title = " + quoted(title) + "\n" + settings + "\n$data << END\n" + data + "\nEND\n";
    report.text += "![" + title + "](" + name + ".svg)\n\n";
}

/// Plots the field y over the field x of those rows that have the values of `where`.
struct Curve {
    std::string name;
    int style; ///< colour 1 to 6, plus 10 for dashes
    std::string x, y;
    Json where = Json::object();
};

/// Returns the points of a curve, one per line. The axes are logarithmic: it skips what is not above 0.
inline std::string points_of(const Curve& curve, const Json& rows) {
    std::string points;
    for (const Json& row : rows) {
        const double x = number(row, curve.x), y = number(row, curve.y);
        bool is_wanted = x > 0 && y > 0 && std::isfinite(x * y);
        for (const auto& field : curve.where.items()) is_wanted &= row.at(field.key()) == field.value();
        if (is_wanted) points += formatted("\n%.6g", x) + formatted(" %.6g", y);
    }
    return points;
}

inline void add_curves(Report& report, const std::string& name, const std::string& title,
                       const std::string& x_label, const std::string& y_label, const Json& rows,
                       const std::vector<Curve>& curves) {
    std::string styles, data;
    for (const Curve& curve : curves) {
        const std::string points = points_of(curve, rows);
        if (points.empty()) continue;
        data += (data.empty() ? "" : "\n\n\n") + quoted(curve.name) + points;
        styles += std::to_string(curve.style) + " ";
    }
    const std::string labels = "x_label = " + quoted(x_label) + "\ny_label = " + quoted(y_label);
    add_plot(report, name, title, "kind = \"curves\"\nstyles = " + quoted(styles) + "\n" + labels, data);
}

/// `groups` holds an object of numbers per group. `kind`: bars or shares. At `reference` a line is drawn.
inline void add_bars(Report& report, const std::string& name, const std::string& title,
                     const std::string& kind, const std::string& y_label, int reference, const Json& groups) {
    if (groups.empty()) return;
    std::string data = "group";
    for (const auto& series : groups.front().items()) data += " " + quoted(series.key());
    for (const auto& group : groups.items()) {
        data += "\n" + quoted(group.key());
        for (const auto& series : groups.front().items()) {
            const double value = number(group.value(), series.key());
            data += std::isfinite(value) ? formatted(" %.6g", value) : " NaN";
        }
    }
    const std::string line = "\nreference = " + std::to_string(reference);
    add_plot(report, name, title, "kind = " + quoted(kind) + "\ny_label = " + quoted(y_label) + line, data);
}

// ---- the parts of the report ----

/// Adds up the counts of rows, field by field.
inline Json sum(const Json& rows) {
    Json total = Json::object();
    for (const Json& row : rows)
        for (const auto& [name, value] : row.items())
            total[name] = total.value(name, std::uint64_t(0)) + count(value);
    return total;
}

inline void add_traversal(Report& report, const Json& json) {
    report.text +=
        "## Traversal\n\nThe same rays through the same triangles, ours and Embree's side by side.\n\n" +
        table(json.at("cases"));
    const double mean = number(json, "geometric_mean_ratio");
    const bool both = std::isfinite(mean);
    if (both) report.text += "Geometric mean of the ratios: " + formatted("%.3f", mean) + ".\n\n";
    const Json total = sum(json.at("checks"));
    if (!total.empty())
        report.text +=
            "The rays on which the sides disagree, by kind. Brute force judged some of them, and some "
            "random rays:\n\n" +
            table(Json::array({total}));
    std::map<std::uint64_t, Json> groups; // by threads: mesh -> rays -> value
    for (const Json& row : json.at("cases"))
        groups[count(row.at("threads"))][row.at("mesh").get<std::string>()]
              [row.at("rays").get<std::string>()] = number(row, both ? "ratio" : "ours_mrays");
    for (const auto& [threads, group] : groups)
        add_bars(report, "traversal_" + std::to_string(threads),
                 std::string("Rays per second, ") + (both ? "ours over Embree's, " : "") +
                     std::to_string(threads) + (threads > 1 ? " threads" : " thread"),
                 "bars", both ? "ratio" : "million rays per second", both, group);
    report.text += "### Build\n\n" + table(json.at("build"));
}

inline void add_scaling(Report& report, const Json& json) {
    Json cases = json.at("cases"), builds = json.at("build");
    report.text += "## Scaling\n\nOne thread, from few triangles to many.\n\n";
    const std::string tables = table(cases) + table(builds), x = "triangles";
    for (Json& row : cases) {
        row["ours_nanoseconds"] = 1e3 / number(row, "ours_mrays");
        row["embree_nanoseconds"] = 1e3 / number(row, "embree_mrays");
    }
    for (Json& row : builds) {
        row["ours_milliseconds"] = 1e3 * number(row, "ours_seconds");
        row["embree_milliseconds"] = 1e3 * number(row, "embree_seconds");
    }
    std::vector<Curve> rays;
    for (const std::string kind : {"primary", "bounce", "shadow"}) {
        const int style = 1 + int(rays.size()) / 2;
        rays.push_back({"ours, " + kind, style, x, "ours_nanoseconds", {{"rays", kind}}});
        rays.push_back({"Embree, " + kind, style + 10, x, "embree_nanoseconds", {{"rays", kind}}});
    }
    add_curves(report, "scaling_ray", "Time per ray", x, "nanoseconds", cases, rays);
    add_curves(report, "scaling_build", "Time to build", x, "milliseconds", builds,
               {{"ours", 1, x, "ours_milliseconds"}, {"Embree", 11, x, "embree_milliseconds"}});
    add_curves(report, "scaling_memory", "Memory of the tree, without the mesh", x, "bytes per triangle",
               builds,
               {{"ours", 1, x, "ours_bytes_per_triangle"},
                {"ours, peak of the build", 2, x, "ours_peak_bytes_per_triangle"},
                {"Embree", 11, x, "embree_bytes_per_triangle"},
                {"Embree, peak of the build", 12, x, "embree_peak_bytes_per_triangle"}});
    report.text += tables;
}

inline void add_renders(Report& report, const Json& json) {
    const Json& rows = json.at("renders");
    report.text +=
        "## Renders\n\nEach step's reference image. The shares are those of one thread, up to the last "
        "ray: 20,000 times per second\na second thread samples whether the program makes its "
        "scene, builds its trees, traces a ray, or does anything else.\n\n" +
        table(rows);
    Json groups;
    for (const Json& row : rows)
        groups[row.at("step").get<std::string>()] = {{"scene and files", row.at("scene_percent")},
                                                     {"tree", row.at("build_percent")},
                                                     {"traversal", row.at("traversal_percent")},
                                                     {"shading", row.at("shading_percent")}};
    add_bars(report, "renders", "Where the time of one thread goes", "shares", "percent", 0, groups);
}

/// Adds a plot per scene, without stratified samples, which are close to Sobol; the table has them.
inline void add_convergence(Report& report, const Json& json) {
    const Json& rows = json.at("convergence");
    report.text += "## Convergence\n\n" + table(rows);
    std::set<std::string> scenes;
    for (const Json& row : rows) scenes.insert(row.at("scene").get<std::string>());
    for (const std::string& scene : scenes) {
        std::vector<Curve> curves;
        for (const auto& [name, style] : {std::pair("MIS", 1), {"book", 2}, {"bounces", 5}, {"lights", 3}})
            for (const std::string sampler : {"random", "sobol"})
                curves.push_back({name + (", " + sampler),
                                  style + (sampler == "random" ? 10 : 0),
                                  "seconds",
                                  "rmse",
                                  {{"scene", scene}, {"estimator", name}, {"sampler", sampler}}});
        add_curves(report, "convergence_" + scene, "Error against time: " + scene, "processor seconds",
                   "error (RMSE of linear radiance)", rows, curves);
    }
}

/// Returns the report on benchmarks, by name. Throws Error if the numbers are not those of a benchmark.
inline Report make_report(const Json& all, bool with_plots) {
    Report report{with_plots, "", {}};
    try {
        if (all.contains("traversal")) add_traversal(report, all["traversal"]);
        if (all.contains("scaling")) add_scaling(report, all["scaling"]);
        if (all.contains("renders")) add_renders(report, all["renders"]);
        if (all.contains("convergence")) add_convergence(report, all["convergence"]);
        if (all.contains("obj")) report.text += "## Loading an OBJ file\n\n" + table(all["obj"].at("obj"));
        if (all.contains("kernels")) // by Google Benchmark
            report.text +=
                "## Kernels\n\nEach alone, its data in the cache.\n\n" +
                table(all["kernels"].at("benchmarks"), {"name", "cpu_time", "time_unit", "items_per_second"});
    } catch (const Json::exception& problem) {
        throw Error(std::string("these are not the numbers of a benchmark: ") + problem.what());
    }
    return report;
}

} // namespace rt::bench
