// The commands that need no build: start, status, hint and undo. `learn` compiles this program, with the few sources that
// it needs, by one call of the compiler; a learner waits seconds for it, and minutes for the whole tutor.
// guide ROOT COMMAND [STEP [NAME]]: flags and wrong numbers of words are left to the tutor.
#include "common/util/report_error.h"
#include "tools/tutor/commands.h"

#include <csignal>
#include <exception>
#include <iostream>

namespace {

int run(const rt::tutor::Project& project, const rt::tutor::Words& words) {
    using namespace rt::tutor;
    const std::string command = words[0], name = words.size() > 2 ? words[2] : "";
    const std::string step = words.size() > 1 ? find_step(project, words[1]) : current_step(project);
    if (command == "start") start_step(project, step, std::cout);
    if (command == "status") show_status(project, std::cout);
    if (command == "hint") show_hints(project, step, name, HintMode::next, std::cout);
    if (command == "undo") undo_files(project, step, name, std::cout);
    if (std::cout.flush()) return 0;
    return rt::report_error("learn", "cannot write to stdout (is the disk full?); everything else worked");
}

} // namespace

int main(int argc, char** argv) {
    if (argc < 3) return rt::report_error("guide", "expected the project's folder and a command");
#ifndef _WIN32
    for (const int signal : {SIGXFSZ, SIGPIPE}) std::signal(signal, SIG_IGN); // a failing write says so
#endif
    try {
        const std::filesystem::path root = argv[1];
        return run({root, root / "workshop"}, {argv + 2, argv + argc});
    } catch (const std::exception& problem) {
        return rt::report_error("learn", problem.what());
    }
}
