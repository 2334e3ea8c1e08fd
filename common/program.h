// A step's program from the outside: knobs in, pictures out, and good manners in between. main.cpp fills in
// what the step is about.
#pragma once

#include "common/options.h"
#include "common/render.h"

#include <functional>

namespace rt {

/// Hand it the function from sample to radiance once the scene stands.
using RenderCall = std::function<void(const SampleFunction&)>;

/// Parses the command line; makes sure, before any work, that the output can be written and the picture held
/// in memory; calls `body`, which builds its scene and calls render(...) once; writes the picture and prints
/// where it is and what it cost. Returns the exit code: 0, or 2 after one line on stderr for bad input.
/// Ctrl-C ends the program at once with a message, code 130, and no half-written file.
int run_program(Options& options, int argc, const char* const* argv,
                const std::function<void(const RenderCall& render)>& body);

} // namespace rt
