// Compiles and runs checks and programs with changed headers, by the compiler and flags of the build: stubs and mistakes
// for ./learn prove, a learner's files for ./learn check. Results are cached by content, so nothing is built twice.
#pragma once

#include "common/util/system.h"
#include "tools/tutor/diagnosis.h"
#include "tools/tutor/gaps.h"

#include <filesystem>
#include <string>
#include <vector>

namespace rt::tutor {

/// The name of each program that is made here.
inline const std::string made_program = std::string("program") + program_ending;

/// What the compiler says: `proof` ignores warnings; `learner` makes those that are mistakes errors.
enum class Strictness { proof, learner };

/// The compiler, its flags and the libraries, as CMake wrote them to prove/toolchain.txt in the build folder.
struct Toolchain {
    std::filesystem::path root; ///< the project's folder
    std::filesystem::path work; ///< the folder for all output
    Strictness strictness = Strictness::proof;
    std::string compiler;
    Words flags;
    std::string test_main;   ///< the object file of doctest's main function
    Words libraries;         ///< the common library and its dependencies
    Words mesh_libraries;    ///< what the steps from 05 on are linked with, too
    std::string fingerprint; ///< a hash of the fields above
};

/// Reads toolchain.txt. Output goes to `work`. Throws Error if it does not exist, or if the libraries are not built.
Toolchain read_toolchain(const std::filesystem::path& root, const std::filesystem::path& build,
                         const std::filesystem::path& work, Strictness strictness);

/// Headers that replace those in steps/.
struct Change {
    std::string step; ///< the step whose checks are run
    std::string id;
    Headers headers;
};

struct Outcome {
    bool compiled = true;
    bool timed_out = false;
    std::string complaint; ///< the compiler's first error in one line
    std::string log;       ///< all that the compiler printed
    std::vector<CheckResult> results;
};

/// Returns the targets of CMake that the checks and the program of a step need; a library is the last. Only the steps from
/// 05 on need the fast tree, the built meshes and the readers of models.
Words targets_for(const std::string& step);

/// Returns what a step's checks and its program are linked with.
Words libraries_for(const Toolchain& tools, const std::string& step);

/// Returns "steps/03_mirror/main.cpp".
std::string program_source(const std::string& step);

/// Adds sources ("tests/03_mirror/mirror.cpp") and all that they include to a hash, without comments.
void add_sources(const Toolchain& tools, const Words& sources, Hash& hash);

/// Returns a hash of the compiler, its flags, a source and all that it includes with the changed headers.
std::string dependency_key(const Toolchain& tools, const Change& change, const std::string& source);

/// Returns "tests/03_mirror/mirror.cpp" and the other checks of the step; those of the changed headers come first, slow
/// statistics last.
Words check_sources(const Toolchain& tools, const Change& change);

/// Precompiles the headers for the checks of the step and for its program, if they are not up to date. Throws Error.
void precompile_headers(const Toolchain& tools, const std::string& step);

/// Compiles and runs one file of checks, or returns the cached outcome.
Outcome run_source(const Toolchain& tools, const Change& change, const std::string& source);

/// Compiles the step's program with the change, as `folder`/made_program. Only `compiled`, `complaint` and `log` of the
/// outcome count.
Outcome build_step(const Toolchain& tools, const Change& change, const std::filesystem::path& folder);

/// What went wrong in a check that crashed: "index beyond the end of a std::vector, in radiance
/// (workshop/03_mirror/radiance.h:34)". Compiles the file of checks again with AddressSanitizer, UBSan and the library's
/// assertions. Empty if these find nothing.
std::string explain_crash(const Toolchain& tools, const Change& change, const std::string& source);

/// Where the first NaN arose: "in reflect (workshop/03_mirror/mirror.h:34)". Compiles the file of checks or the program
/// again with nan_trap.h and runs it with the arguments. Empty if none arose in a function of the learner's.
std::string explain_nan(const Toolchain& tools, const Change& change, const std::string& source,
                        const Words& arguments);

/// The place of the first of the stacks that nan_trap.h prints that is in a learner's function, or in a library that it
/// calls. A NaN that arises in the reference's functions or in a check is no fault.
std::string first_nan(const std::string& stacks);

} // namespace rt::tutor
