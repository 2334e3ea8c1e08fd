// ./learn bench: builds the benchmarks, runs them in sequence, and writes a report of the results.
#include "common/util/report_error.h"
#include "common/util/error.h"
#include "common/util/file_bytes.h"
#include "common/util/json.h"
#include "tools/tutor/build.h"
#include "tools/tutor/commands.h"
#include "tools/tutor/system.h"
#include "tools/tutor/util.h"

#include <iostream>

namespace rt::tutor {

namespace fs = std::filesystem;

namespace {

struct Benchmark {
    std::string name, target;
    std::string package;              ///< the Debian package that it needs in addition
    Words defaults, quick;            ///< each "--flag=value", used if the user does not set that flag
    std::string json_flag = "--json"; ///< the program's flag for the JSON output file
};

const std::vector<Benchmark>& benchmarks() { // in the order in which the report shows them
    static const std::vector<Benchmark> all{
        {"traversal", "bench_traversal", "libembree-dev", {}, {"--quick"}},
        {"scaling",
         "bench_traversal",
         "libembree-dev",
         {"--threads=1", "--checks=-1", "--meshes=1k,3k,10k,30k,100k,300k,1M,3M,10M", "--rounds=5"},
         {"--threads=1", "--checks=-1", "--quick", "--meshes=1k,10k,100k"}},
        {"renders", "bench_renders", "", {}, {"--quick"}},
        {"convergence", "bench_convergence", "", {}, {"--quick"}},
        {"obj", "bench_obj_loading", "", {}, {"--triangles=20000", "--rounds=1", "--no-mesh"}},
        {"kernels",
         "bench_kernels",
         "libbenchmark-dev",
         {"--benchmark_out_format=json"},
         {"--benchmark_out_format=json", "--benchmark_min_time=0.01"},
         "--benchmark_out="}};
    return all;
}

std::vector<Benchmark> find_benchmarks(const std::string& name) {
    std::vector<Benchmark> found;
    std::string names;
    for (const Benchmark& benchmark : benchmarks()) {
        if (name.empty() || name == "all" || name == benchmark.name) found.push_back(benchmark);
        names += " " + benchmark.name;
    }
    if (found.empty())
        throw Error("there is no benchmark '" + printable(name) + "'; the benchmarks are all" + names +
                    " loop");
    return found;
}

bool asks_for_help(const Words& flags) {
    return contains(flags, "-h") || contains(flags, "--help");
}

/// Offers to install packages that only benchmarks need: asks on a terminal, otherwise prints the command.
void offer_packages(const fs::path& root, const std::vector<Benchmark>& chosen) {
    Words missing;
    for (const Benchmark& benchmark : chosen) {
        if (benchmark.package.empty() || contains(missing, benchmark.package)) continue;
        std::string status;
        try {
            run_process({"dpkg-query", "-W", "-f=${Package}=${db:Status-Status}", benchmark.package},
                        {.log = root / "build/learn.log", .output = &status});
        } catch (const Error&) {
            return; // no Debian
        }
        if (trimmed(status) != benchmark.package + "=installed") missing.push_back(benchmark.package);
    }
    if (missing.empty()) return;
    std::string answer;
    if (is_terminal(0) && is_terminal(1)) {
        std::cout << "install " << joined(missing, " ")
                  << " to compare with Embree and to time the kernels? [y/N] " << std::flush;
        std::getline(std::cin, answer);
    }
    if (answer != "y" && answer != "Y" && answer != "yes") {
        std::cout << "not installed: " << joined(missing, " ")
                  << "; some results will be missing. To get them: apt-get install " << joined(missing, " ")
                  << std::endl;
        return;
    }
    Words setup{text_of(root / "learn"), "setup"};
    append(setup, missing);
    if (run_process(setup).code != 0) throw CommandFailed("the packages could not be installed");
}

/// Returns the benchmarks that can be built here. A benchmark whose package is missing has no build target.
std::vector<Benchmark> buildable(const Preset& preset, const std::vector<Benchmark>& chosen) {
    configure(preset, true); // detects packages that were installed since the last time
    const std::string rules = read_file(text_of(preset.folder() / "build.ninja"));
    std::vector<Benchmark> kept;
    for (const Benchmark& benchmark : chosen)
        if (rules.find("\nbuild " + benchmark.target + ":") != rules.npos ||
            rules.starts_with("build " + benchmark.target))
            kept.push_back(benchmark);
    if (kept.empty()) throw CommandFailed("the benchmark " + chosen[0].name + " cannot be built here");
    return kept;
}

/// Returns the given flags, preceded by those defaults that they do not override.
Words with_defaults(const Words& defaults, const Words& given) {
    Words flags;
    for (const std::string& flag : defaults) {
        const std::string name = flag.substr(0, flag.find('='));
        const auto is_it = [&](const std::string& word) {
            return word == name || word.starts_with(name + "=");
        };
        if (std::ranges::none_of(given, is_it)) flags.push_back(flag);
    }
    append(flags, given);
    return flags;
}

/// Runs one benchmark, which writes NAME.json into `out`. Throws Stop or CommandFailed.
void run(const Preset& preset, const Benchmark& benchmark, const BenchOptions& options, const fs::path& out) {
    const fs::path json = out / (benchmark.name + ".json");
    std::cout << "--- " << benchmark.name << std::endl;
    Words command{text_of(preset.program(benchmark.target)), benchmark.json_flag};
    if (benchmark.json_flag.ends_with('='))
        command.back() += text_of(json);
    else
        command.push_back(text_of(json));
    append(command, with_defaults(options.quick ? benchmark.quick : benchmark.defaults, options.flags));
    wait_for_program(path_of(command[0]));
    const int code = run_process(command).code;
    std::error_code missing;
    const bool written = fs::file_size(json, missing) > 0 && !missing; // Google Benchmark always exits with 0
    if (code == 2 || (code == 0 && !written)) throw Stop{2};           // the program has printed the error
    if (code == 129 || code == 130 || code == 143) throw Stop{code};
    if (code != 0)
        throw CommandFailed("the benchmark " + benchmark.name + " failed with exit code " +
                            std::to_string(code));
}

/// Returns the results as JSON: {"traversal": {...}, ...}, or without the outer object if
/// `one` was requested.
std::string numbers(const std::vector<Benchmark>& chosen, const fs::path& out, bool one) {
    Json all;
    for (const Benchmark& benchmark : chosen)
        all[benchmark.name] = Json::parse(read_file(text_of(out / (benchmark.name + ".json"))));
    return json::text(one ? all.front() : all, 1) + "\n";
}

} // namespace

void run_benchmarks(const Project& project, const BenchOptions& options) {
    if (options.name == "loop") {
        const Preset preset{project.root};
        make(preset, {"tutor", "checks"});
        replace_process({"bash", text_of(project.root / "tools/tutor/loop.sh"), text_of(project.root),
                         text_of(preset.folder()), options.json});
    }
    std::vector<Benchmark> chosen = find_benchmarks(options.name);
    const Preset preset{project.root, "bench"};
    const bool all = options.name.empty() || options.name == "all";
    if (all && !options.flags.empty())
        throw Error("unknown argument '" + printable(options.flags[0]) +
                    "'; flags for one benchmark go after its name: ./learn bench traversal --help");
    const fs::path out = options.out.empty() ? preset.folder() / "report" : path_of(options.out);
    if (!options.json.empty()) check_file_writable(options.json);
    make_folder(out);
    offer_packages(project.root, chosen);
    chosen = buildable(preset, chosen);
    Words targets{"bench_report"};
    for (const Benchmark& benchmark : chosen) targets.push_back(benchmark.target);
    make(preset, targets);
    if (asks_for_help(options.flags)) replace_process({text_of(preset.program(chosen[0].target)), "--help"});
    for (const Benchmark& benchmark : chosen) run(preset, benchmark, options, out);
    if (run_process({text_of(preset.program("bench_report")), text_of(out)}).code != 0)
        throw CommandFailed("the report could not be written");
    if (!options.json.empty()) write_file(options.json, numbers(chosen, out, !all));
    std::cout << "report: " << display_path(out / "report.md") << "\n";
}

} // namespace rt::tutor
