// What each step's reference picture costs: seconds and rays a second with all threads, and where one
// thread's time goes, which a program built from the same main.cpp tells (watched.h).
#include "common/util/report_error.h"
#include "common/util/error.h"
#include "common/util/json.h"
#include "tools/bench/statistics.h"

#include <CLI/CLI.hpp>

#include <array>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

namespace rt::bench {

struct Wish {
    std::vector<std::string> steps;
    int rounds = 3, threads = 0;
    std::string json;
    bool quick = false;
};

/// What a program has said, and how long it took from start to end.
struct Said {
    std::string text;
    double seconds;
};

Said run_program(const std::string& command) {
    const auto start = std::chrono::steady_clock::now();
    std::FILE* const pipe = popen((command + " 2>&1").c_str(), "r");
    if (!pipe) throw Error("cannot run " + command);
    Said said;
    std::array<char, 4096> buffer;
    while (std::fgets(buffer.data(), buffer.size(), pipe)) said.text += buffer.data();
    if (pclose(pipe) != 0) throw Error("this failed: " + command + ": " + said.text);
    said.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return said;
}

/// The line that begins with `word`, without it.
std::istringstream line_of(const std::string& text, const std::string& word) {
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);)
        if (line.starts_with(word + " ")) return std::istringstream(line.substr(word.size() + 1));
    throw Error("the program does not print a line '" + word + "': " + text);
}

/// Of the line "time 2.31 s, 123456 rays, ...".
struct Cost {
    double seconds = 0, rays = 0;
};

Cost cost_of(const std::string& text) {
    Cost cost;
    std::string unit;
    line_of(text, "time") >> cost.seconds >> unit >> cost.rays;
    return cost;
}

std::string flags(const std::string& name, const Wish& wish, int threads) {
    const std::string out = (std::filesystem::path(RT_OUT) / name).string();
    std::filesystem::create_directories(RT_OUT);
    return " --out \"" + out + ".hdr\"" + (threads > 0 ? " --threads " + std::to_string(threads) : "") +
           (wish.quick ? " --width 96 --height 60 --samples 1" : "");
}

std::string measure(const std::string& step, const Wish& wish) {
    std::vector<double> whole, seconds, rates;
    double rays = 0;
    for (int i = 0; i < wish.rounds; ++i) {
        const Said said = run_program("\"" RT_BIN "/" + step + "\"" + flags(step, wish, wish.threads));
        const Cost cost = cost_of(said.text);
        rays = cost.rays;
        whole.push_back(said.seconds);
        seconds.push_back(cost.seconds);
    }
    std::array<double, 4> shares{};
    double samples = 0;
    const Said watched = run_program("\"" RT_BIN "/watched_" + step + "\"" + flags(step, wish, 1));
    std::istringstream line = line_of(watched.text, "shares");
    for (double& share : shares) line >> share;
    line >> samples;
    const double mrays = median(seconds) > 0 ? rays / median(seconds) * 1e-6 : unknown;
    std::printf(
        "%-15s %7.2f s, render %7.2f s, %7.2f Mrays/s; one thread: scene %4.1f %%, build %4.1f %%, traversal "
        "%4.1f %%, shading %4.1f %%\n",
        step.c_str(), median(whole), median(seconds), mrays, 100 * shares[0], 100 * shares[1],
        100 * shares[2], 100 * shares[3]);
    std::fflush(stdout);
    return json::object({{"step", json::text(step)},
                         {"seconds", json::number(median(whole))},
                         {"render_seconds", json::number(median(seconds))},
                         {"rays", json::number(std::int64_t(rays))},
                         {"mrays_per_second", json::number(mrays)},
                         {"scene_share", json::number(shares[0])},
                         {"build_share", json::number(shares[1])},
                         {"traversal_share", json::number(shares[2])},
                         {"shading_share", json::number(shares[3])},
                         {"samples", json::number(std::int64_t(samples))}});
}

void run(Wish wish) {
    if (wish.steps.empty()) {
        std::istringstream all(RT_STEPS);
        for (std::string step; all >> step;) wish.steps.push_back(step);
    }
    if (wish.quick) wish.rounds = 1;
    json::check_writable(wish.json);
    std::vector<std::string> renders;
    for (const std::string& step : wish.steps) renders.push_back(measure(step, wish));
    json::write(wish.json, json::object({{"renders", json::array(renders)}}));
}

} // namespace rt::bench

int main(int argc, char** argv) {
    rt::bench::Wish wish;
    CLI::App app("Times each step's reference picture, and says where the time goes.", "bench_renders");
    std::istringstream all(RT_STEPS);
    std::vector<std::string> names;
    for (std::string step; all >> step;) names.push_back(step);
    app.add_option("--steps", wish.steps, "the steps, separated by commas; all if not given")
        ->delimiter(',')
        ->check(CLI::IsMember(names));
    app.add_option("--rounds", wish.rounds, "how often each is rendered; the median counts")
        ->check(CLI::Range(1, 1000));
    app.add_option("--threads", wish.threads, "0: all cores")->check(CLI::Range(0, 1024));
    app.add_option("--json", wish.json, "a file for the numbers");
    app.add_flag("--quick", wish.quick, "tiny pictures: does it run?");
    try {
        app.parse(argc, argv);
        rt::bench::run(wish);
        return 0;
    } catch (const CLI::CallForHelp& help) {
        return app.exit(help);
    } catch (const std::exception& problem) {
        return rt::report_error("bench_renders", problem.what());
    }
}
