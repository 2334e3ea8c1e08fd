// Checks that are run on changed headers: a stub, or a mistake. The step's checks are compiled with the
// changed headers first on the include path; what came is kept by content, so that nothing is built twice.
#pragma once

#include "tools/tutor/diagnosis.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace rt::tutor {

/// How the build compiles and links, as CMake wrote it to prove/toolchain.txt in the build's folder.
struct Toolchain {
    std::filesystem::path root; ///< of the project
    std::filesystem::path work; ///< where everything that is made goes
    std::string compiler;
    Words flags;
    std::string test_main; ///< the object of doctest's own code
    Words libraries;       ///< the common library, and those that it needs
    std::string fixed;     ///< a hash of all of these
};

/// Throws Error if it is not there.
Toolchain read_toolchain(const std::filesystem::path& root, const std::filesystem::path& build);

/// Headers that take the place of those in steps/, by their name ("03_mirror/mirror.h").
struct Change {
    std::string step; ///< whose checks to run
    std::string id;
    std::map<std::string, std::string> headers;
};

struct Outcome {
    bool compiled = true;
    bool timed_out = false;
    std::string complaint; ///< of the compiler
    std::vector<CheckResult> results;
};

/// Of all that the proof of a step depends on: its checks, whatever they include, and its mistakes.
std::string proof_key(const Toolchain& tools, const std::string& step);

/// Compiles what the checks of the step and its program include, once. Throws Error.
void prepare(const Toolchain& tools, const std::string& step);

/// The outcome of the first file of the step's checks in which something fails, or of all of them; the files
/// of the changed headers come first, slow statistics last. Throws Error if the tools do not work.
Outcome run_checks(const Toolchain& tools, const Change& change);

/// Compiles the step's program with the change and renders a small picture with it. False if there is none in
/// the end.
bool render_picture(const Toolchain& tools, const Change& change, const std::filesystem::path& picture);

} // namespace rt::tutor
