// Runs CMake and ninja, and finds the first error in their output ("file:line:column: error: message").
#include "tools/tutor/build.h"

#include "common/util/report_error.h"
#include "common/util/cores.h"
#include "common/util/file_bytes.h"
#include "tools/tutor/exercises.h"
#include "tools/tutor/system.h"

#include <algorithm>
#include <chrono>
#include <iostream>
#include <sstream>

namespace rt::tutor {

namespace fs = std::filesystem;

namespace {

/// Removes the last colon and the text after it, and returns that text; empty if there is no colon.
std::string last_part(std::string& text) {
    const std::size_t colon = text.rfind(':');
    if (colon == std::string::npos) return "";
    const std::string part = text.substr(colon + 1);
    text.resize(colon);
    return part;
}

bool is_number(const std::string& text) {
    return !text.empty() && text.size() < 9 && text.find_first_not_of("0123456789") == std::string::npos;
}

std::optional<CompileError> error_in(const std::string& line) {
    for (const std::string mark : {": error: ", ": fatal error: "}) {
        const std::size_t place = line.find(mark);
        if (place == std::string::npos) continue;
        std::string file = line.substr(0, place);
        const std::string column = last_part(file), number = last_part(file);
        if (is_number(column) && is_number(number) && !file.empty())
            return CompileError{file, std::stoi(number), line.substr(place + mark.size())};
    }
    return std::nullopt;
}

} // namespace

std::optional<CompileError> first_error(const std::string& log, const std::string& preferred) {
    std::optional<CompileError> first;
    std::istringstream lines(log);
    for (std::string line; std::getline(lines, line);) {
        const auto error = error_in(line);
        if (error && error->file.find(preferred) != std::string::npos) return error;
        if (!first) first = error;
    }
    return first;
}

namespace {

fs::path log_of(const Preset& preset) {
    return preset.root / "build" / "learn.log";
}

[[noreturn]] void give_up(const Preset& preset) {
    std::cout << "failed" << std::endl;
    for (const std::string& line : lines_of(read_file(text_of(log_of(preset))))) print_error_line(line);
    throw CommandFailed("the build failed; its output is above and in " + text_of(log_of(preset)) +
                        "; if your files are not the cause, remove " + text_of(preset.folder()) +
                        " and try again");
}

/// Returns whether a file did not compile, or a program did not link.
bool compiling_failed(const Preset& preset) {
    return std::ranges::any_of(lines_of(read_file(text_of(log_of(preset)))), [](const std::string& line) {
        return line.starts_with("FAILED: ") && line.find("build.ninja") == line.npos &&
               line.find("verify_globs") == line.npos;
    });
}

bool configure_locked(const Preset& preset, bool again) {
    std::error_code ignored;
    const fs::path made = preset.folder() / "build.ninja";
    write_file(text_of(log_of(preset)), "");
    if (fs::exists(made, ignored) && !again) return true;
    fs::remove(made, ignored);
    const Words command{"cmake", "--preset", preset.name, "-S", text_of(preset.root)};
    return run_process(command, {.log = log_of(preset), .append = true}).code == 0;
}

bool build_locked(const Preset& preset, const Words& targets) {
    if (!configure_locked(preset, false)) return false;
    Words command{"cmake", "--build", text_of(preset.folder()), "--target"};
    command.insert(command.end(), targets.begin(), targets.end());
    return run_process(command, {.log = log_of(preset), .append = true}).code == 0;
}

/// Builds, and again with new build files if nothing failed to compile: a crash or a full disk may have left broken
/// ones. Compiled objects are kept.
bool build_patiently(const Preset& preset, const Words& targets) {
    for (const char* const broken : {"build.ninja", "CMakeCache.txt"}) {
        if (build_locked(preset, targets)) return true;
        if (compiling_failed(preset)) return false;
        std::error_code ignored;
        for (const char* const name :
             {broken, "build.ninja", "CMakeFiles/VerifyGlobs.cmake", "CMakeFiles/cmake.verify_globs"})
            fs::remove(preset.folder() / name, ignored);
    }
    return build_locked(preset, targets);
}

} // namespace

void configure(const Preset& preset, bool again) {
    const BuildLock alone(preset.folder());
    if (!configure_locked(preset, again)) give_up(preset);
}

void make(const Preset& preset, const Words& targets, bool quiet) {
    const BuildLock alone(preset.folder());
    const auto begin = std::chrono::steady_clock::now();
    if (!quiet) std::cout << "building... " << std::flush;
    if (!build_patiently(preset, targets)) give_up(preset);
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - begin;
    if (!quiet) std::cout << int(time.count()) << " s" << std::endl;
}

void wait_for_program(const fs::path& program) {
    std::error_code missing;
    const fs::perms allowed = fs::status(program, missing).permissions();
    if (missing || (allowed & fs::perms::owner_exec) == fs::perms::none)
        const BuildLock lock(program.parent_path().parent_path());
}

void hand_over(const Preset& preset, const std::string& tool, const Words& arguments) {
    make(preset, {tool}, true);
    Words command{text_of(preset.program(tool))};
    wait_for_program(path_of(command[0]));
    command.insert(command.end(), arguments.begin(), arguments.end());
    replace_process(command);
}

} // namespace rt::tutor
