// ./learn watch: checks again at each save.
#pragma once

#include "tools/tutor/check.h"

#include <ostream>

namespace rt {

/// Until q is typed (or the input ends where it is no terminal). Answers the exit code of the last check.
int watch_step(const Project& project, const CheckWish& wish, std::ostream& out);

} // namespace rt
