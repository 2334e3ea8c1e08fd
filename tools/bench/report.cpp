// bench_report FOLDER: makes report.md and plots from traversal.json, scaling.json, ... in the folder.
#include "tools/bench/report.h"
#include "common/util/file_bytes.h"
#include "common/util/report_error.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <thread>

namespace rt::bench {
namespace {

/// Returns what the benchmarks have written, by name.
Json read_numbers() {
    Json all = Json::object();
    for (const std::string name : {"traversal", "scaling", "renders", "convergence", "obj", "kernels"}) {
        if (!std::filesystem::exists(name + ".json")) continue;
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

bool succeeds(const std::string& command) {
    return std::system(command.c_str()) == 0;
}

/// Reads and writes in the working folder.
void write_report() {
    const bool has_gnuplot = succeeds("gnuplot --version >/dev/null 2>&1");
    if (!has_gnuplot)
        print_error_line(
            "bench_report: no plots, as there is no gnuplot (Debian: apt-get install gnuplot-nox)");
    const Report report = make_report(read_numbers(), has_gnuplot);
    for (const auto& [name, data] : report.plots) {
        write_file(name + ".txt", data);
        if (!succeeds("gnuplot -c '" RT_PLOT "' '" + name + ".txt' '" + name + ".svg'"))
            throw Error("gnuplot does not draw " + name + ".txt");
    }
    write_file("report.md", "# Benchmarks\n\n" + machine() + report.text);
}

} // namespace
} // namespace rt::bench

int main(int argc, char** argv) {
    try {
        if (argc != 2) throw rt::Error("name the folder of traversal.json and the others");
        std::filesystem::current_path(argv[1]);
        rt::bench::write_report();
        return 0;
    } catch (const std::exception& problem) {
        return rt::report_error("bench_report", problem.what());
    }
}
