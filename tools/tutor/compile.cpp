// Reads "file:line:column: error: message", which GCC and Clang agree on.
#include "tools/tutor/compile.h"

#include "common/util/cores.h"
#include "common/util/file_bytes.h"
#include "tools/tutor/build_lock.h"
#include "tools/tutor/process.h"

#include <algorithm>
#include <chrono>
#include <fstream>
#include <future>
#include <sstream>

namespace rt {

namespace fs = std::filesystem;

namespace {

/// What stands before the last colon, which is taken off; empty if there is none.
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

/// The build tool names what it has made, line by line.
bool is_linked(const fs::path& said, const std::string& target) {
    std::ifstream lines(said);
    for (std::string line; std::getline(lines, line);)
        if (line.ends_with("bin/" + target)) return true;
    return false;
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

Built build_targets(const fs::path& build, const std::vector<std::string>& targets, const fs::path& said,
                    const std::string& preferred, const std::function<void()>& first_is_there) {
    const std::string jobs = std::to_string(usable_cores()); // ninja takes two more
    std::vector<std::string> command{"/usr/bin/env", "cmake", "--build", build.string(),
                                     "--parallel",   jobs,    "--target"};
    command.insert(command.end(), targets.begin(), targets.end());
    auto ended = std::async(std::launch::async, [&] {
        const BuildLock alone(build);
        return run_process(command, said);
    });
    bool told = !first_is_there;
    while (ended.wait_for(std::chrono::milliseconds(20)) != std::future_status::ready) {
        if (told || !is_linked(said, targets[0])) continue;
        told = true;
        first_is_there();
    }
    Built built{ended.get().code == 0, std::nullopt, read_file(said.string())};
    if (!built.well) built.error = first_error(built.log, preferred);
    if (built.well && !told) first_is_there();
    return built;
}

} // namespace rt
