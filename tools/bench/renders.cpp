// Measures what each step's reference picture costs: seconds and rays per second with all threads, and where
// one thread's time goes, by a program built from the same main.cpp (profiled.h).
#include "common/util/error.h"
#include "tools/bench/program.h"
#include "tools/bench/statistics.h"

#include <array>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <sstream>

namespace rt::bench {

struct RenderOptions {
    std::vector<std::string> steps;
    int rounds = 3, threads = 0;
    std::string json;
    bool quick = false;
};

/// What a program has printed, and how long it ran.
struct ProgramRun {
    std::string output;
    double seconds;
};

ProgramRun run_step(const std::string& program, const std::string& step, int threads, bool quick) {
    std::filesystem::create_directories(RT_OUT);
    const std::string command = "\"" RT_BIN "/" + program + "\" --out \"" RT_OUT "/" + step + ".hdr\"" +
                                (threads > 0 ? " --threads " + std::to_string(threads) : "") +
                                (quick ? " --width 96 --height 60 --samples 1" : "") + " 2>&1";
    const auto start = std::chrono::steady_clock::now();
    std::FILE* const pipe = popen(command.c_str(), "r");
    if (!pipe) throw Error("cannot run " + command);
    ProgramRun run;
    std::array<char, 4096> buffer;
    while (std::fgets(buffer.data(), buffer.size(), pipe)) run.output += buffer.data();
    if (pclose(pipe) != 0) throw Error("this failed: " + command + ": " + run.output);
    run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return run;
}

/// The rest of the line that begins with `word`.
std::istringstream line_of(const std::string& text, const std::string& word) {
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);)
        if (line.starts_with(word + " ")) return std::istringstream(line.substr(word.size() + 1));
    throw Error("the program does not print a line '" + word + "': " + text);
}

Json measure(const std::string& step, const RenderOptions& options) {
    std::vector<double> seconds, render_seconds;
    std::int64_t rays = 0;
    for (int i = 0; i < options.rounds; ++i) {
        const ProgramRun run = run_step(step, step, options.threads, options.quick);
        seconds.push_back(run.seconds);
        std::string unit;
        line_of(run.output, "time") >> render_seconds.emplace_back() >> unit >>
            rays; // "time 2.31 s, 123456 rays, ..."
    }
    std::array<double, 4> shares{};
    std::istringstream line = line_of(run_step("profiled_" + step, step, 1, options.quick).output, "shares");
    for (double& share : shares) line >> share;
    const Json row{{"step", step},
                   {"seconds", median(seconds)},
                   {"render_seconds", median(render_seconds)},
                   {"rays", rays},
                   {"mrays_per_second", 1e-6 * double(rays) / median(render_seconds)},
                   {"scene_percent", 100 * shares[0]},
                   {"build_percent", 100 * shares[1]},
                   {"traversal_percent", 100 * shares[2]},
                   {"shading_percent", 100 * shares[3]}};
    print_row(row);
    return row;
}

std::vector<std::string> all_steps() {
    std::istringstream names(RT_STEPS);
    return {std::istream_iterator<std::string>(names), {}};
}

} // namespace rt::bench

int main(int argc, char** argv) {
    using namespace rt::bench;
    RenderOptions options{all_steps()};
    CLI::App app("Times each step's reference picture, and says where the time goes.", "bench_renders");
    app.add_option("--steps", options.steps, "the steps, separated by commas; all if not given")
        ->delimiter(',')
        ->check(CLI::IsMember(all_steps()));
    app.add_option("--rounds", options.rounds, "how often each is rendered; the median counts")
        ->check(CLI::Range(1, 1000));
    app.add_option("--threads", options.threads, "0: all cores")->check(CLI::Range(0, 1024));
    app.add_flag("--quick", options.quick, "tiny pictures: does it run?");
    add_json_option(app, options.json);
    return run_program(app, argc, argv, [&] {
        if (options.quick) options.rounds = 1;
        check_json(options.json);
        rt::Json rows = rt::Json::array();
        for (const std::string& step : options.steps) rows.push_back(measure(step, options));
        write_json(options.json, {{"renders", rows}});
    });
}
