// What the programs of the benchmarks share: their command line, and the file for their numbers.
#pragma once

#include "common/util/report_error.h"
#include "common/util/file_bytes.h"
#include "common/util/json.h"

#include <CLI/CLI.hpp>

#include <functional>
#include <string>

namespace rt::bench {

/// Parses the command line and calls `action`. Returns the exit code: 2, after one line on stderr, if that
/// fails.
inline int run_program(CLI::App& app, int argc, char** argv, const std::function<void()>& action) {
    try {
        app.parse(argc, argv);
        action();
        return 0;
    } catch (const CLI::CallForHelp& help) {
        return app.exit(help);
    } catch (const std::exception& problem) {
        return report_error(app.get_name(), problem.what());
    }
}

/// Adds the option --json. The action shall call check_json before its work and write_json after it.
inline void add_json_option(CLI::App& app, std::string& path) {
    app.add_option("--json", path, "a file for the numbers");
}

/// Throws Error if write_json could not write this file; an empty path is no file.
inline void check_json(const std::string& path) {
    if (!path.empty()) check_file_writable(path);
}

inline void write_json(const std::string& path, const Json& numbers) {
    if (!path.empty()) write_file(path, json::text(numbers, 1) + "\n");
}

/// Sets the value for --quick, unless the user gave the option.
inline void set_by_default(const CLI::App& app, const char* option, auto& value, auto quick) {
    if (app.count(option) == 0) value = quick;
}

} // namespace rt::bench
