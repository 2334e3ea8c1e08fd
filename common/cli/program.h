// Runs a step's program: parses the options, checks the outputs, renders, writes the files, reports errors.
#pragma once

#include "common/cli/options.h"
#include "common/render/render.h"

#include <functional>
#include <string>

/// The learner's headers that this program is built with, as in "03_mirror/mirror.h": the build says which.
#if !defined(RT_WORKSHOP)
#define RT_WORKSHOP ""
#endif

namespace rt {

/// Hand it the function from sample to radiance once the scene stands.
using RenderFunction = std::function<void(const SampleFunction&)>;

/// Parses the command line; makes sure, before any work, that the output can be written and the picture held
/// in memory; calls `body`, which builds its scene and calls render(...) once; writes the picture and prints
/// where it is and what it cost. Returns the exit code: 0, or 2 after one line on stderr for bad input or
/// for a picture that had to be saved in another place. Ctrl-C, TERM and HUP end the program immediately with
/// a message and no half-written file; it dies of the signal. It prints `overridden_headers`.
int run_program(Options& options, int argc, const char* const* argv,
                const std::function<void(const RenderFunction& render)>& body,
                const std::string& overridden_headers = RT_WORKSHOP);

} // namespace rt
