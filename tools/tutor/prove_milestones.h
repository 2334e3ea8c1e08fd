// Shows that the milestones of a step are true.
#pragma once

#include "tools/tutor/toolchain.h"

#include <string>

namespace rt::tutor {

/// Renders the picture of each milestone: by the reference with gaps in place of all later functions. Each must differ
/// from the one before, seen with the same options, and the last one must be the reference's. With `write` the pictures
/// are kept in exercises/NN_name/milestones/. Returns what is wrong. Throws Error.
Words prove_milestones(const Toolchain& tools, const std::string& step, bool write);

} // namespace rt::tutor
