// What bench_report makes of the numbers that the benchmarks write: a report in Markdown, and the data of its
// plots.
#pragma once

#include "common/util/error.h"
#include "tools/bench/table.h"

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace rt::bench {

struct Report {
    bool with_plots = true;
    std::string text;
    std::map<std::string, std::string> plots; ///< by name; tools/figures/plot.gp says what is in it
};

// ---- plots ----

/// A text for gnuplot, in quotes; characters that mean something to it are left out.
inline std::string quoted(std::string text) {
    std::erase_if(text, [](char c) { return c == '"' || c == '\\' || c == '`' || (c >= 0 && c < ' '); });
    return "\"" + text + "\"";
}

inline void add_plot(Report& report, const std::string& name, const std::string& title,
                     const std::string& settings, const std::string& data) {
    if (!report.with_plots || data.empty()) return;
    report.plots[name] = "title = " + quoted(title) + "\n" + settings + "$data << END\n" + data + "END\n";
    report.text += "![" + title + "](" + name + ".svg)\n\n";
}

struct Curve {
    std::string name;
    int style; ///< colour 1 to 6, plus 10 for dashes
    std::vector<std::pair<double, double>> points;
};

/// Points that are not above 0 are left out, as the axes are logarithmic.
inline void add_curves(Report& report, const std::string& name, const std::string& title,
                       const std::string& x_label, const std::string& y_label,
                       const std::vector<Curve>& curves) {
    std::string styles, data;
    for (const Curve& curve : curves) {
        std::string block;
        for (const auto& [x, y] : curve.points)
            if (x > 0 && y > 0 && std::isfinite(x * y))
                block += formatted("%.6g ", x) + formatted("%.6g\n", y);
        if (block.empty()) continue;
        data += (data.empty() ? "" : "\n\n") + quoted(curve.name) + "\n" + block;
        styles += std::to_string(curve.style) + " ";
    }
    add_plot(report, name, title,
             "kind = \"curves\"\nx_label = " + quoted(x_label) + "\ny_label = " + quoted(y_label) +
                 "\nstyles = " + quoted(styles) + "\n",
             data);
}

/// `groups` holds an object of numbers per group. `kind` is bars or shares.
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
    add_plot(report, name, title,
             "kind = " + quoted(kind) + "\ny_label = " + quoted(y_label) +
                 "\nreference = " + std::to_string(reference) + "\n",
             data + "\n");
}

// ---- the parts of the report ----

inline void add_traversal(Report& report, const Json& json) {
    report.text +=
        "## Traversal\n\nThe same rays through the same triangles, ours and Embree's side by side.\n\n" +
        table(json.at("cases"));
    const double mean = number(json, "geometric_mean_ratio");
    const bool both = std::isfinite(mean);
    if (both) report.text += "Geometric mean of the ratios: " + formatted("%.3f", mean) + ".\n\n";
    Json total = Json::object();
    for (const Json& check : json.at("checks"))
        for (const auto& field : check.items())
            total[field.key()] =
                total.value(field.key(), std::uint64_t(0)) + field.value().get<std::uint64_t>();
    if (!total.empty())
        report.text += "Of all rays, those on which the sides disagree, by kind; some of these, and some "
                       "random rays, were "
                       "judged by brute force:\n\n" +
                       table(Json::array({total}));
    std::map<int, Json> groups; // by threads: mesh -> rays -> value
    for (const Json& row : json.at("cases"))
        groups[row.at("threads").get<int>()][row.at("mesh").get<std::string>()]
              [row.at("rays").get<std::string>()] = number(row, both ? "ratio" : "ours_mrays");
    for (const auto& [threads, group] : groups)
        add_bars(report, "traversal_" + std::to_string(threads),
                 std::string(both ? "Rays per second, ours over Embree's, " : "Rays per second, ") +
                     std::to_string(threads) + (threads > 1 ? " threads" : " thread"),
                 "bars", both ? "ratio" : "million rays per second", both, group);
    report.text += "### Build\n\n" + table(json.at("build"));
}

/// A field of rows over their numbers of triangles, times `factor`; only of rows with these rays, if given.
inline Curve curve(const Json& rows, const std::string& rays, const std::string& name, int style,
                   const std::string& field, double factor) {
    Curve result{name, style, {}};
    for (const Json& row : rows)
        if (rays.empty() || row.at("rays") == rays)
            result.points.emplace_back(number(row, "triangles"), factor * number(row, field));
    return result;
}

inline void add_scaling(Report& report, const Json& json) {
    const Json &cases = json.at("cases"), &builds = json.at("build");
    report.text += "## Scaling\n\nOne thread, from few triangles to many.\n\n";
    std::vector<Curve> rays;
    int style = 0;
    for (const std::string kind : {"primary", "bounce", "shadow"}) {
        ++style;
        rays.push_back(curve(cases, kind, "ours, " + kind, style, "ours_mrays", 1));
        rays.push_back(curve(cases, kind, "Embree, " + kind, style + 10, "embree_mrays", 1));
    }
    for (Curve& one : rays)
        for (auto& point : one.points) point.second = 1e3 / point.second;
    add_curves(report, "scaling_ray", "Time per ray", "triangles", "nanoseconds", rays);
    add_curves(report, "scaling_build", "Time to build", "triangles", "milliseconds",
               {curve(builds, "", "ours", 1, "ours_seconds", 1e3),
                curve(builds, "", "Embree", 11, "embree_seconds", 1e3)});
    add_curves(report, "scaling_memory", "Memory of the tree, without the mesh", "triangles",
               "bytes per triangle",
               {curve(builds, "", "ours", 1, "ours_bytes_per_triangle", 1),
                curve(builds, "", "ours, peak of the build", 2, "ours_peak_bytes_per_triangle", 1),
                curve(builds, "", "Embree", 11, "embree_bytes_per_triangle", 1),
                curve(builds, "", "Embree, peak of the build", 12, "embree_peak_bytes_per_triangle", 1)});
    report.text += table(cases) + table(builds);
}

inline void add_renders(Report& report, const Json& json) {
    const Json& rows = json.at("renders");
    report.text += "## Renders\n\nEach step's reference picture. The shares are those of one thread, up to "
                   "the last ray: a "
                   "second thread samples 20,000 times per second whether the program makes its scene, "
                   "builds its trees, "
                   "traces a ray, or does anything else.\n\n" +
                   table(rows);
    Json groups;
    for (const Json& row : rows)
        groups[row.at("step").get<std::string>()] = {{"scene and files", row.at("scene_percent")},
                                                     {"tree", row.at("build_percent")},
                                                     {"traversal", row.at("traversal_percent")},
                                                     {"shading", row.at("shading_percent")}};
    add_bars(report, "renders", "Where the time of one thread goes", "shares", "percent", 0, groups);
}

/// A plot per scene; stratified samples are left out, close to Sobol: the table tells them apart.
inline void add_convergence(Report& report, const Json& json) {
    static const std::map<std::string, int> styles{{"MIS", 1}, {"lights", 3}, {"bounces", 5}, {"book", 2}};
    const Json& rows = json.at("convergence");
    report.text += "## Convergence\n\n" + table(rows);
    std::map<std::string, std::map<std::string, Curve>> curves; // by scene and name
    for (const Json& row : rows) {
        const std::string estimator = row.at("estimator"), sampler = row.at("sampler");
        if (sampler == "stratified") continue;
        Curve& curve = curves[row.at("scene").get<std::string>()][estimator + ", " + sampler];
        curve.name = estimator + ", " + sampler;
        curve.style = styles.at(estimator) + (sampler == "random" ? 10 : 0);
        curve.points.emplace_back(number(row, "seconds"), number(row, "rmse"));
    }
    for (const auto& [scene, named] : curves) {
        std::vector<Curve> list;
        for (const auto& [name, curve] : named) list.push_back(curve);
        add_curves(report, "convergence_" + scene, "Error against time: " + scene, "processor seconds",
                   "error (RMSE of linear radiance)", list);
    }
}

/// The report of all benchmarks that have run, by name. Throws Error if the numbers are not those of a
/// benchmark.
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
                "## Kernels\n\nEach alone, its data in the cache. The items of a tree are triangles.\n\n" +
                table(all["kernels"].at("benchmarks"), {"name", "cpu_time", "time_unit", "items_per_second"});
    } catch (const std::exception& problem) { // of nlohmann-json, or of styles.at()
        throw Error(std::string("these are not the numbers of a benchmark: ") + problem.what());
    }
    return report;
}

} // namespace rt::bench
