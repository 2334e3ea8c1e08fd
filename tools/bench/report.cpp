// bench_report FOLDER: turns the numbers of traversal.json, scaling.json, ... in a folder into report.md and
// plots.
#include "tools/bench/report.h"
#include "tools/bench/program.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <thread>

namespace rt::bench {

namespace fs = std::filesystem;

/// What the benchmarks have written, by name.
Json read_numbers() {
    Json all = Json::object();
    for (const std::string name : {"traversal", "scaling", "renders", "convergence", "obj", "kernels"}) {
        if (!fs::exists(name + ".json")) continue;
        try {
            all[name] = Json::parse(read_file(name + ".json"));
        } catch (const Json::exception& problem) {
            throw Error(name + ".json: " + problem.what());
        }
    }
    return all;
}

std::string machine() {
    std::ifstream cpu("/proc/cpuinfo");
    std::string name = "a machine";
    for (std::string line; std::getline(cpu, line);)
        if (line.starts_with("model name")) name = line.substr(std::min(line.find(':'), line.size() - 2) + 2);
    return "Measured on " + name + ", " + std::to_string(std::thread::hardware_concurrency()) +
           " hardware threads, compiled by " RT_COMPILER ".\n\n";
}

void run(const std::string& folder) {
    fs::current_path(folder);
    const bool has_gnuplot = std::system("gnuplot --version >/dev/null 2>&1") == 0;
    if (!has_gnuplot)
        print_error_line(
            "bench_report: no plots, as there is no gnuplot (Debian: apt-get install gnuplot-nox)");
    const Report report = make_report(read_numbers(), has_gnuplot);
    for (const auto& [name, data] : report.plots) {
        write_file(name + ".txt", data);
        const std::string files = "' '" + name + ".txt' '" + name + ".svg'";
        if (std::system(("gnuplot -c '" RT_PLOT + files).c_str()) != 0)
            throw Error("gnuplot does not draw " + name + ".txt");
    }
    write_file("report.md", "# Benchmarks\n\n" + machine() + report.text);
}

} // namespace rt::bench

int main(int argc, char** argv) {
    std::string folder;
    CLI::App app("Writes report.md and plots from the numbers in a folder.", "bench_report");
    app.add_option("folder", folder, "where traversal.json and the others are")
        ->required()
        ->check(CLI::ExistingDirectory);
    return rt::bench::run_program(app, argc, argv, [&] { rt::bench::run(folder); });
}
