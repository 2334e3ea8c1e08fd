// Reads "file:line:column: error: message", which GCC and Clang agree on.
#include "tools/tutor/compile.h"

#include "common/file_bytes.h"
#include "tools/tutor/process.h"

#include <regex>
#include <sstream>

namespace rt {

std::optional<CompileError> first_error(const std::string& log, const std::string& preferred) {
    static const std::regex pattern(R"(^(.+?):(\d+):\d+: (?:fatal )?error: (.*)$)");
    std::optional<CompileError> first;
    std::istringstream lines(log);
    std::smatch found;
    for (std::string line; std::getline(lines, line);) {
        if (line.find("error: ") == std::string::npos || !std::regex_match(line, found, pattern)) continue;
        const CompileError error{found[1], std::stoi(found[2]), found[3]};
        if (error.file.find(preferred) != std::string::npos) return error;
        if (!first) first = error;
    }
    return first;
}

Built build_targets(const std::filesystem::path& build, const std::vector<std::string>& targets,
                    const std::filesystem::path& said, const std::string& preferred) {
    std::vector<std::string> command{"/usr/bin/env", "cmake", "--build", build.string(), "--target"};
    command.insert(command.end(), targets.begin(), targets.end());
    const Ended ended = run_process(command, said);
    Built built{ended.code == 0, std::nullopt, read_file(said.string())};
    if (!built.well) built.error = first_error(built.log, preferred);
    return built;
}

} // namespace rt
