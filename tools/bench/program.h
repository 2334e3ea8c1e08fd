// The frame of a benchmark's program: its command line, and the file for its numbers.
#pragma once

#include "common/util/file_bytes.h"
#include "common/util/report_error.h"
#include "tools/bench/numbers.h"

#include <CLI/CLI.hpp>

#include <functional>
#include <string>
#include <vector>

namespace rt::bench {

/// Declares a number, or several that are separated by commas.
void add_number(CLI::App& app, const char* name, auto& value, int min, int max, const char* help) {
    app.add_option(name, value, help)->delimiter(',')->check(CLI::Range(min, max));
}

/// Declares one of these words, or several that are separated by commas.
void add_choice(CLI::App& app, const char* name, auto& value, std::vector<std::string> choices,
                const char* help) {
    app.add_option(name, value, help)->delimiter(',')->check(CLI::IsMember(choices));
}

/// Parses the command line, measures, and writes the numbers into the file of --json, if that is given.
/// Returns the exit code: 2, after one line on stderr, if that fails.
inline int run_program(CLI::App& app, int argc, char** argv, const std::function<Json()>& measure) {
    std::string path;
    app.add_option("--json", path, "a file for the numbers");
    try {
        app.parse(argc, argv);
        if (!path.empty()) check_file_writable(path);
        const Json numbers = measure();
        if (!path.empty()) write_file(path, json::text(numbers, 1) + "\n");
        return 0;
    } catch (const CLI::CallForHelp& help) {
        return app.exit(help);
    } catch (const std::exception& problem) {
        return report_error(app.get_name(), problem.what());
    }
}

} // namespace rt::bench
