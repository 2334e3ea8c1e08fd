// The program behind the commands of ./learn.
// Exit code: 0 success, 1 a check failed or a picture is wrong, 2 the command is wrong or a file cannot be
// read or written.
#include "tools/tutor/build.h"
#include "tools/tutor/commands.h"
#include "tools/tutor/system.h"
#include "tools/tutor/util.h"

#include "common/util/report_error.h"
#include "common/util/error.h"
#include "common/util/version.h"

#include <CLI/CLI.hpp>

#include <cstdlib>
#include <exception>
#include <functional>
#include <iostream>
#include <string>

namespace rt::tutor {

namespace {

/// The arguments of all commands; each command reads those that it needs.
struct Arguments {
    std::string root = ".", workshop, build, step, name, junit;
    Words steps;
    bool merge = false, only_build = false, again = false, all = false, reset = false, no_picture = false,
         open = false;
    Pixel pixel;
    BenchOptions bench;
    FuzzOptions fuzz;
    int minutes = 0;
    int code = 0; ///< the exit code of the command

    Project project() const {
        const std::filesystem::path folder = path_of(root);
        return {folder, workshop.empty() ? folder / "workshop" : path_of(workshop)};
    }
    std::string full_step() const {
        return step.empty() ? current_step(project()) : find_step(project(), step);
    }
    HintMode hint_mode() const {
        if (reset) return HintMode::reset;
        if (all) return HintMode::all;
        return again ? HintMode::again : HintMode::next;
    }
};

/// Returns whether to print colours: stdout is a terminal that supports them, and the user has not turned
/// them off (no-color.org).
bool colour_is_welcome() {
    const char* const refused = std::getenv("NO_COLOR");
    const char* const terminal = std::getenv("TERM");
    return !(refused && *refused) && !(terminal && std::string(terminal) == "dumb") && is_terminal(1);
}

CLI::App* add_command(CLI::App& app, const std::string& name, const std::string& help,
                      const std::function<void()>& action) {
    CLI::App* const command = app.add_subcommand(name, help);
    command->callback(action);
    return command;
}

CLI::Option* add_step(CLI::App* command, Arguments& given) {
    return command->add_option("STEP", given.step,
                               "the step: 3, 03 or 03_mirror; where it may be left out, the one you are in");
}

void add_check(CLI::App& app, Arguments& given, const std::string& name, const std::string& help,
               int (*check)(const Project&, const CheckOptions&, std::ostream&)) {
    CLI::App* const command = add_command(app, name, help, [&given, check] {
        const Project project = given.project();
        const std::filesystem::path build =
            given.build.empty() ? project.root / "build/release" : path_of(given.build);
        const int columns = terminal_columns(1);
        const CheckOptions options{.step = given.full_step(),
                                   .build = build,
                                   .picture = !given.no_picture,
                                   .colour = colour_is_welcome(),
                                   .width = columns > 0 ? columns : 100,
                                   .open = given.open};
        given.code = check(project, options, std::cout);
    });
    add_step(command, given);
    command->add_flag("--no-picture", given.no_picture, "run only the checks");
    command->add_flag("--open", given.open, "open the report in the browser");
    command->add_option("--build", given.build, "the build folder, by default ROOT/build/release");
}

void add_hint(CLI::App& app, Arguments& given) {
    CLI::App* const hint = add_command(
        app, "hint", "Shows the next of three hints: what to look at, which formula, which line.", [&given] {
            show_hints(given.project(), given.full_step(), given.name, given.hint_mode(), std::cout);
        });
    add_step(hint, given);
    hint->add_option("FUNCTION", given.name,
                     "such as reflected_ray; without it, lists the functions of the step");
    CLI::Option* const again = hint->add_flag("--again", given.again, "show the last hint again");
    CLI::Option* const all = hint->add_flag("--all", given.all, "show all three hints")->excludes(again);
    hint->add_flag("--reset", given.reset, "start again with the first hint")->excludes(again)->excludes(all);
}

void add_workshop_commands(CLI::App& app, Arguments& given) {
    CLI::App* const start = add_command(
        app, "start",
        "Copies the files of a step into workshop/, with gaps for you to fill in. Never overwrites a file.",
        [&given] { (given.merge ? merge_step : start_step)(given.project(), given.full_step(), std::cout); });
    add_step(start, given)->required();
    start->add_flag("--merge", given.merge,
                    "merge what has changed in the reference since then into your files, which are kept in "
                    "workshop/.backup/");
    add_check(
        app, given, "check",
        "Builds your files, runs the checks of the step and of the earlier steps, renders, compares the "
        "picture with the reference, and says what is likely wrong and what to do next. Exit code 0 only "
        "if everything passes.",
        check_step);
    add_check(app, given, "watch", "Runs the check again each time you save a file; q quits.", watch_step);
    add_command(app, "status", "Shows which steps are done, and what to do next.",
                [&given] { show_status(given.project(), std::cout); });
    add_command(app, "course",
                "Renders all eight steps and the cover of a well-known book with your programs, and writes a "
                "page to share.",
                [&given] { make_course_page(given.project(), given.open); })
        ->add_flag("--open", given.open, "open the page in the browser");
    add_hint(app, given);
    CLI::App* const diff = add_command(
        app, "diff",
        "Shows the differences between the reference (-) and your file (+). This shows the solution.",
        [&given] {
            show_diff(given.project(), given.full_step(), given.name, colour_is_welcome(), std::cout);
        });
    CLI::App* const undo = add_command(
        app, "undo", "Moves your file into workshop/.backup/, so that the reference is used again.",
        [&given] { undo_files(given.project(), given.full_step(), given.name, std::cout); });
    for (CLI::App* const command : {diff, undo}) {
        add_step(command, given)->required();
        command->add_option("FILE", given.name, "such as mirror.h; without it, all your files of the step");
    }
}

/// Adds a command that passes all its arguments, except for a leading STEP but including --help,
/// to another program.
CLI::App* add_wrapper(CLI::App& app, const std::string& name, const std::string& help,
                      const std::function<void(const Words&)>& action) {
    CLI::App* const command = app.add_subcommand(name, help);
    command->set_help_flag();
    command->prefix_command();
    command->callback([command, action] { action(command->remaining()); });
    return command;
}

void add_run(CLI::App& app, Arguments& given) {
    CLI::App* run = nullptr;
    run = add_wrapper(
        app, "run",
        "Renders a step, or all steps, into renders/, and compares with the reference pictures. Flags after "
        "the step are passed to its program; ./learn run 03 --help lists them.",
        [&given, &app](const Words& flags) {
            if (given.step.empty() && !flags.empty()) {
                if (flags[0] == "-h" || flags[0] == "--help") {
                    std::cout << app.get_subcommand("run")->help();
                    return;
                }
                throw Error("the step is missing; for example: ./learn run 03 " + joined(flags, " "));
            }
            given.code = run_steps(given.project(), given.step.empty() ? "" : given.full_step(), flags);
        });
    add_step(run, given);
}

void add_trace(CLI::App& app, Arguments& given) {
    CLI::App* trace = nullptr;
    trace = add_command(
        app, "trace",
        "Prints the rays of one pixel: what each ray hits and the radiance that it returns. Further flags "
        "are passed to the step's program.",
        [&given, &app] {
            trace_pixel(given.project(), given.full_step(), given.pixel,
                        app.get_subcommand("trace")->remaining());
        });
    add_step(trace, given)->required();
    constexpr int most = 1 << 24;
    trace->add_option("COLUMN", given.pixel.x, "from 0 at the left")->required()->check(CLI::Range(0, most));
    trace->add_option("ROW", given.pixel.y, "from 0 at the top")->required()->check(CLI::Range(0, most));
    trace->add_option("--sample", given.pixel.sample, "which sample of the pixel, from 1")
        ->check(CLI::Range(1, most));
    trace->allow_extras();
}

void add_own_programs(CLI::App& app, Arguments& given) {
    CLI::App* const debug =
        add_command(app, "debug",
                    "Builds your program of a step for a debugger, and starts gdb, or lldb, on it. Further "
                    "flags are passed "
                    "to the program; by default it uses one thread and one sample per pixel.",
                    [&given, &app] {
                        debug_step(given.project(), given.full_step(),
                                   app.get_subcommand("debug")->remaining(), given.only_build);
                    });
    add_step(debug, given);
    debug->add_flag("--only-build", given.only_build,
                    "only build build/debugger/NN_name, for the debugger of an editor");
    debug->allow_extras();
    CLI::App* const scene = add_command(
        app, "scene", "Writes workshop/scenes/NAME.cpp, an example of a scene of your own.", [&given] {
            const Project project = given.project();
            write_scene(project, given.name, find_step(project, given.step.empty() ? "08" : given.step),
                        std::cout);
        });
    scene->add_option("NAME", given.name, "such as lamp")->required();
    scene->add_option("STEP", given.step, "the step that shows it, from 05 on; by default 08");
}

void add_test(CLI::App& app, Arguments& given) {
    CLI::App* const test =
        add_command(app, "test", "Builds and runs all checks, or those of one step or group.",
                    [&given] { given.code = run_tests(given.project(), given.name, given.junit); });
    test->add_option(
        "WHICH", given.name,
        "a step, or common, compare, guards, bench, tutor, docs, fuzz, statistics, faults or reference");
    test->add_option("--junit", given.junit, "write the results to this file as JUnit XML");
}

void add_bench(CLI::App& app, Arguments& given) {
    CLI::App* const bench =
        app.add_subcommand("bench", "Measures the speed of all parts, and writes a report with plots.");
    bench->add_option(
        "NAME", given.bench.name,
        "traversal, scaling, renders, convergence, obj or kernels; loop measures how long a learner waits "
        "for a check. Further flags, including --help, are passed to the benchmark's program");
    bench->add_flag("--quick", given.bench.quick, "only a short run, to see that it works");
    bench->add_option("--json", given.bench.json, "write the results to this file");
    bench->add_option("--out", given.bench.out, "write the report into this folder");
    bench->set_help_flag();
    bench->allow_extras();
    bench->callback([&given, bench] {
        given.bench.flags = bench->remaining();
        const bool help = contains(given.bench.flags, "--help") || contains(given.bench.flags, "-h");
        if (help && given.bench.name.empty())
            std::cout << bench->help();
        else
            run_benchmarks(given.project(), given.bench);
    });
}

void add_fuzz(CLI::App& app, Arguments& given) {
    CLI::App* const command = add_command(
        app, "fuzz",
        "Tests the parsers with generated inputs (libFuzzer), under AddressSanitizer and "
        "UndefinedBehaviorSanitizer: first the past findings and the seeds in tests/fuzz, then new inputs, "
        "one minute per target, two targets at a time. A target stops at its first finding, which is kept "
        "in build/fuzz/found/TARGET. Exit code: 0 nothing found, 1 something found, 2 the command is wrong.",
        [&given] {
            if (given.minutes > 0) given.fuzz.seconds = 60 * given.minutes;
            const Words targets = fuzz_targets(given.project());
            if (!given.fuzz.target.empty() && !contains(targets, given.fuzz.target))
                throw Error("there is no target '" + given.fuzz.target + "'; the targets are " +
                            joined(targets, " "));
            given.code = fuzz(given.project(), given.fuzz);
        });
    command->add_option("TARGET", given.fuzz.target, "by default all targets");
    command->footer([&given] { return "Targets: " + joined(fuzz_targets(given.project()), " "); });
    const CLI::Range from_one(1, 99999);
    command->add_option("--seconds", given.fuzz.seconds, "time per target")->check(from_one);
    command->add_option("--minutes", given.minutes, "time per target, in minutes")->check(from_one);
    command->add_option("--seed", given.fuzz.seed, "seed of libFuzzer's random numbers")->check(from_one);
}

void add_maintenance(CLI::App& app, Arguments& given) {
    const auto tool = [&](const std::string& name, const std::string& help, const Words& first) {
        add_wrapper(app, name, help, [&given, name, first](const Words& words) {
            Words all = first.empty() ? Words{} : Words{"--root", given.root};
            append(all, words);
            hand_over({path_of(given.root)}, name, all);
        });
    };
    tool("compare", "Says whether two pictures are the same, and if not, how they differ.", {});
    tool("weave", "Updates the listings, diffs, galleries and outputs in the chapters.", {"--root"});
    add_wrapper(app, "prove",
                "Proves that the checks work: each gap and each known mistake makes them fail, and the "
                "mistake is named.",
                [&given](const Words& words) {
                    const Preset preset{path_of(given.root)};
                    make(preset, {"prove", "test_main", "models", "raysteps_accel"});
                    Words command{text_of(preset.program("prove")), "--root", given.root, "--build",
                                  text_of(preset.folder())};
                    wait_for_program(path_of(command[0]));
                    append(command, words);
                    replace_process(command);
                });
    CLI::App* const figures =
        add_command(app, "figures",
                    "Creates the pictures and plots of the chapters, and prints their settings.", [&given] {
                        Words steps;
                        for (const std::string& step : given.steps)
                            steps.push_back(find_step(given.project(), step));
                        make_figures(given.project(), steps);
                    });
    figures->add_option("STEPS", given.steps, "only those of these chapters");
    add_step(
        add_command(
            app, "references",
            "Renders the reference pictures into assets/reference/, and docs/contact_sheet.png. You need "
            "this only if you change a step.",
            [&given] { make_references(given.project(), given.step.empty() ? "" : given.full_step()); }),
        given);
}

int run(int argc, char** argv) {
    Arguments given;
    CLI::App app("Guides you through the steps. ./learn --help lists the commands.", "./learn");
    app.allow_windows_style_options(false); // a path may begin with a slash
    app.require_subcommand(1);
    app.set_version_flag("--version", version());
    app.add_option("--root", given.root, "the project's folder");
    app.add_option("--workshop", given.workshop, "the folder of your files, by default ROOT/workshop");
    add_workshop_commands(app, given);
    add_run(app, given);
    add_trace(app, given);
    add_own_programs(app, given);
    add_test(app, given);
    add_bench(app, given);
    add_fuzz(app, given);
    add_maintenance(app, given);
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& help) {
        return app.exit(help);
    }
    if (!std::cout.flush())
        return report_error("learn", "cannot write to stdout (is the disk full?); everything else worked");
    return given.code;
}

} // namespace

} // namespace rt::tutor

int main(int argc, char** argv) {
    rt::prepare_streams();
    rt::tutor::handle_signals();
    try {
        return rt::tutor::run(argc, argv);
    } catch (const rt::tutor::Stop& stop) {
        if (stop.code > 128) rt::print_error_line("stopped");
        return stop.code;
    } catch (const rt::tutor::CommandFailed& failure) {
        rt::report_error("learn", failure.what());
        return 1;
    } catch (const std::exception& problem) {
        return rt::report_error("learn", problem.what());
    }
}
