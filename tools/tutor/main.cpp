// The program behind ./learn start, status, hint, diff and undo. Exit code: 0 all is said and done, 2 wrong words or a
// file that cannot be read or written.
#include "tools/tutor/check.h"
#include "tools/tutor/commands.h"
#include "tools/tutor/watch.h"

#include "common/util/report_error.h"

#include <CLI/CLI.hpp>

#include <csignal>
#include <cstdlib>
#include <exception>
#include <functional>
#include <iostream>
#include <string>

#if defined(_WIN32)
#include <io.h>
#else
#include <unistd.h>
#endif

namespace {

/// What was typed; each command reads its part.
struct Words {
    std::string root = ".", workshop;
    std::string step, name;
    std::string build;
    bool again = false, all = false, reset = false, no_picture = false;
    int code = 0; ///< what the command answers
};

rt::Project project_of(const Words& words) {
    const std::filesystem::path root(words.root);
    return {root, words.workshop.empty() ? root / "workshop" : std::filesystem::path(words.workshop)};
}

rt::HintWish wish_of(const Words& words) {
    if (words.reset) return rt::HintWish::reset;
    if (words.all) return rt::HintWish::all;
    return words.again ? rt::HintWish::again : rt::HintWish::next;
}

/// A person looks on, whose terminal shows colours and who has not asked for none (no-color.org).
bool colour_is_welcome() {
    const char* const refused = std::getenv("NO_COLOR");
    const char* const terminal = std::getenv("TERM");
    if (refused && *refused) return false;
    if (terminal && std::string(terminal) == "dumb") return false;
#if defined(_WIN32)
    return _isatty(1);
#else
    return isatty(1) == 1;
#endif
}

CLI::App* add_command(CLI::App& app, const std::string& name, const std::string& help,
                      const std::function<void()>& action) {
    CLI::App* const command = app.add_subcommand(name, help);
    command->callback(action);
    return command;
}

CLI::App* with_step(CLI::App* command, Words& words) {
    command->add_option("STEP", words.step, "3, 03 and 03_mirror all name a step")->required();
    return command;
}

void add_start(CLI::App& app, Words& words) {
    CLI::App* const start = add_command(
        app, "start", "Cuts the files of a step into workshop/, with gaps where you write; never overwrites.",
        [&words] {
            const rt::Project project = project_of(words);
            start_step(project, find_step(project, words.step), std::cout);
        });
    with_step(start, words);
}

void add_check(CLI::App& app, Words& words, const std::string& name, const std::string& help,
               int (*check)(const rt::Project&, const rt::CheckWish&, std::ostream&)) {
    CLI::App* const command = add_command(app, name, help, [&words, check] {
        const rt::Project project = project_of(words);
        const std::filesystem::path build =
            words.build.empty() ? project.root / "build" / "release" : std::filesystem::path(words.build);
        words.code = check(project, {find_step(project, words.step), build, !words.no_picture}, std::cout);
    });
    with_step(command, words);
    command->add_flag("--no-picture", words.no_picture, "the checks alone");
    command->add_option("--build", words.build, "the folder of the build, if not ROOT/build/release");
}

void add_status(CLI::App& app, Words& words) {
    add_command(app, "status", "Shows the steps, what is done, and what is next.",
                [&words] { show_status(project_of(words), std::cout); });
}

void add_hint(CLI::App& app, Words& words) {
    CLI::App* const hint = add_command(
        app, "hint", "Gives the next of three hints: what to look at, which formula, which line.", [&words] {
            const rt::Project project = project_of(words);
            show_hints(project, find_step(project, words.step), words.name, wish_of(words), std::cout);
        });
    with_step(hint, words);
    hint->add_option("FUNCTION", words.name,
                     "as in reflected_ray; without it, a list of the step's functions");
    CLI::Option* const again = hint->add_flag("--again", words.again, "the last hint once more");
    CLI::Option* const all = hint->add_flag("--all", words.all, "all three")->excludes(again);
    hint->add_flag("--reset", words.reset, "forget which were shown")->excludes(again)->excludes(all);
}

void add_diff(CLI::App& app, Words& words) {
    CLI::App* const diff = add_command(
        app, "diff", "Shows the reference (-) against your file (+): it gives the answer away.", [&words] {
            const rt::Project project = project_of(words);
            show_diff(project, find_step(project, words.step), words.name, colour_is_welcome(), std::cout);
        });
    with_step(diff, words);
    diff->add_option("FILE", words.name, "as in mirror.h; without it, all your files of the step");
}

void add_undo(CLI::App& app, Words& words) {
    CLI::App* const undo = add_command(
        app, "undo", "Moves your file into workshop/.backup/, so that the reference counts again.", [&words] {
            const rt::Project project = project_of(words);
            undo_files(project, find_step(project, words.step), words.name, std::cout);
        });
    with_step(undo, words);
    undo->add_option("FILE", words.name, "as in mirror.h; without it, all your files of the step");
}

/// What would kill the program where a write fails becomes an error of that write.
void make_writes_safe() {
#if defined(SIGXFSZ) && defined(SIGPIPE)
    std::signal(SIGXFSZ, SIG_IGN);
    std::signal(SIGPIPE, SIG_IGN);
#endif
}

} // namespace

int main(int argc, char** argv) {
    make_writes_safe();
    Words words;
    CLI::App app("Goes through the steps with you.", "./learn");
    app.require_subcommand(1);
    app.add_option("--root", words.root, "the project's folder");
    app.add_option("--workshop", words.workshop, "where your files are, if not in ROOT/workshop");
    add_start(app, words);
    add_check(
        app, words, "check",
        "Runs the step's checks on your files and those of the steps before, renders, compares, and says "
        "what is likely wrong and what to do next. Exit code 0 only when all hold.",
        rt::check_step);
    add_check(app, words, "watch", "Checks again at each save; q ends.", rt::watch_step);
    add_status(app, words);
    add_hint(app, words);
    add_diff(app, words);
    add_undo(app, words);
    try {
        app.parse(argc, argv);
        return std::cout.flush()
                   ? words.code
                   : rt::report_error("learn",
                                      "stdout takes no more text (is the disk full?); all else went well");
    } catch (const CLI::CallForHelp& help) {
        return app.exit(help);
    } catch (const std::exception& problem) {
        return rt::report_error("learn", problem.what());
    }
}
