// Runs checks with changed headers: a stub, or a mistake.
// The step's checks are compiled with the changed headers first on the include path. Results are cached by
// content, so that nothing is built twice.
#pragma once

#include "tools/tutor/diagnosis.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace rt::tutor {

/// The compiler, its flags and the libraries, as CMake wrote them to prove/toolchain.txt in the build folder.
struct Toolchain {
    std::filesystem::path root; ///< the project's folder
    std::filesystem::path work; ///< the folder for all output
    std::string compiler;
    Words flags;
    std::string test_main;   ///< the object file of doctest's main function
    Words libraries;         ///< the common library and its dependencies
    std::string fingerprint; ///< a hash of all fields above
};

/// Reads toolchain.txt. Throws Error if it does not exist.
Toolchain read_toolchain(const std::filesystem::path& root, const std::filesystem::path& build);

/// Headers that replace those in steps/, by name ("03_mirror/mirror.h").
struct Change {
    std::string step; ///< the step whose checks are run
    std::string id;
    std::map<std::string, std::string> headers;
};

struct Outcome {
    bool compiled = true;
    bool timed_out = false;
    std::string complaint; ///< the compiler's first error
    std::vector<CheckResult> results;
};

/// Returns a hash of everything that the proof of a step depends on: its checks, their includes,
/// and its mistakes.
std::string proof_key(const Toolchain& tools, const std::string& step);

/// Precompiles the headers for the checks of the step and for its program. Throws Error.
void precompile_headers(const Toolchain& tools, const std::string& step);

/// Returns the outcome of the first file of the step's checks in which something fails, or of all files. The
/// files of the changed headers come first, slow statistics last. Throws Error if the tools do not work.
Outcome run_checks(const Toolchain& tools, const Change& change);

/// Compiles the step's program with the change and renders a small picture. Returns false if it
/// produced no picture.
bool render_picture(const Toolchain& tools, const Change& change, const std::filesystem::path& picture);

} // namespace rt::tutor
