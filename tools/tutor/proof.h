// Runs checks with changed headers: a stub, or a mistake.
#pragma once

#include "tools/tutor/toolchain.h"

#include <filesystem>
#include <string>

namespace rt::tutor {

/// Returns a hash of everything that the proof of a step depends on: its checks, their includes,
/// its mistakes and its right variants.
std::string proof_key(const Toolchain& tools, const std::string& step);

/// Returns the outcome of the first file of the step's checks in which something fails, or of all files. The
/// files of the changed headers come first, slow statistics last. Throws Error if the tools do not work.
Outcome run_checks(const Toolchain& tools, const Change& change);

/// Compiles the step's program with the change and renders a small picture. Returns false if it
/// produced no picture.
bool render_picture(const Toolchain& tools, const Change& change, const std::filesystem::path& picture);

/// Renders the step's picture with the change into `folder` and judges it as ./learn check does. Returns what is wrong with
/// it; empty if nothing is.
std::string picture_complaint(const Toolchain& tools, const Change& change,
                              const std::filesystem::path& folder);

} // namespace rt::tutor
