// Runs a step's program: parses the options, checks the outputs, renders, writes the files, reports errors.
#pragma once

#include "common/cli/options.h"
#include "common/render/render.h"

#include <functional>
#include <string>

/// The learner's own headers that this program is built with, as in "03_mirror/mirror.h". Set by the build.
#if !defined(RT_WORKSHOP)
#define RT_WORKSHOP ""
#endif

namespace rt {

/// Renders the image: call it with the radiance function once the scene is built.
using RenderFunction = std::function<void(const SampleFunction&)>;

/// Runs a program. Parses the command line; checks that the output can be written and the image fits in
/// memory; calls `body`, which builds its scene and calls render(...) exactly once; writes the image
/// and prints its path and cost. Returns the exit code: 0, or 2 after one line on stderr for invalid
/// input or for an image that could not be written to its place. SIGINT, SIGTERM and SIGHUP end the
/// program immediately, with a message and no half-written file; it dies of the signal.
/// `overridden_headers` is printed unless empty.
int run_program(Options& options, int argc, const char* const* argv,
                const std::function<void(const RenderFunction& render)>& body,
                const std::string& overridden_headers = RT_WORKSHOP);

} // namespace rt
