// An input error in one line: what is wrong, where, and what to do. Programs print it and exit with 2.
#pragma once

#include <stdexcept>

namespace rt {

struct Error : std::runtime_error {
    using std::runtime_error::runtime_error;
};

} // namespace rt
