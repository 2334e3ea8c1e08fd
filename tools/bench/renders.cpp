// Measures what each step's reference image costs: seconds and rays per second with all threads, and where
// the time of one thread goes, by a program built from the same main.cpp (profiled.h).
#include "common/util/error.h"
#include "tools/bench/program.h"

#include <filesystem>
#include <sstream>

namespace rt::bench {
namespace {

/// Runs a step's program and returns what it prints.
std::string run_step(const std::string& program, const std::string& step, int threads, bool quick) {
    std::filesystem::create_directories(RT_OUT);
    const std::string command = "\"" RT_BIN "/" + program + "\" --out \"" RT_OUT "/" + step +
                                ".hdr\" --threads " + std::to_string(threads) +
                                (quick ? " --width 96 --height 60 --samples 1 2>&1" : " 2>&1");
    std::FILE* const pipe = popen(command.c_str(), "r");
    if (!pipe) throw Error("cannot run " + command);
    std::string output;
    for (int c = 0; (c = std::fgetc(pipe)) != EOF;) output += char(c);
    if (pclose(pipe) != 0) throw Error("this failed: " + command + ": " + output);
    return output;
}

/// Returns the rest of the line that begins with `word`.
std::istringstream line_of(const std::string& text, const std::string& word) {
    const std::size_t begin = ("\n" + text).find("\n" + word + " ");
    if (begin == text.npos) throw Error("the program does not print a line '" + word + "': " + text);
    return std::istringstream(text.substr(begin + word.size() + 1));
}

/// Renders a step several times; `quick` renders a tiny image once.
Json measure(const std::string& step, int rounds, int threads, bool quick) {
    std::vector<double> seconds, render_seconds;
    std::int64_t rays = 0;
    for (int i = 0; i < (quick ? 1 : rounds); ++i) {
        const Stopwatch watch;
        const std::string output = run_step(step, step, threads, quick);
        seconds.push_back(watch.wall());
        std::string unit;
        line_of(output, "time") >> render_seconds.emplace_back() >> unit >>
            rays; // "time 2.31 s, 123456 rays, ..."
    }
    std::istringstream shares = line_of(run_step("profiled_" + step, step, 1, quick), "shares");
    Json row{{"step", step},
             {"seconds", median(seconds)},
             {"render_seconds", median(render_seconds)},
             {"rays", rays},
             {"mrays_per_second", 1e-6 * double(rays) / median(render_seconds)}};
    for (const char* name : {"scene_percent", "build_percent", "traversal_percent", "shading_percent"}) {
        double share = 0;
        shares >> share;
        row[name] = 100 * share;
    }
    print_row(row);
    return row;
}

} // namespace
} // namespace rt::bench

int main(int argc, char** argv) {
    using namespace rt::bench;
    std::vector<std::string> steps{RT_STEPS};
    int rounds = 3, threads = 0;
    bool quick = false;
    CLI::App app("Times each step's reference image, and says where the time goes.", "bench_renders");
    add_choice(app, "--steps", steps, steps, "the steps, separated by commas; all if not given");
    add_number(app, "--rounds", rounds, 1, 1000, "how often each is rendered; the median counts");
    add_number(app, "--threads", threads, 0, 1024, "0: all cores");
    app.add_flag("--quick", quick, "tiny images: does it run?");
    return run_program(app, argc, argv, [&] {
        rt::Json rows;
        for (const std::string& step : steps) rows.push_back(measure(step, rounds, threads, quick));
        return rt::Json{{"renders", rows}};
    });
}
