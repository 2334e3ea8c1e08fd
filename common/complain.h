// How every program refuses: one line on stderr, exit code 2.
#pragma once

#include <string>

namespace rt {

/// Prints "program: message", after all that was printed before; answers 2. A message keeps to its line, whatever was
/// typed or named in a file.
int complain(const std::string& program, std::string message);

} // namespace rt
