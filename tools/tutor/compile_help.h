// What a learner needs of a compiler's hundred lines: the first error in one of their files, the source line with the
// caret below it, and for the commonest errors one sentence on what to do.
#pragma once

#include "tools/tutor/build.h"

#include <optional>
#include <string>

namespace rt::tutor {

struct CompileHelp {
    CompileError error;
    Words source;       ///< the line and its caret as the compiler shows them; may be empty
    std::string remedy; ///< one sentence, or empty
};

/// Returns the first error in `log`, in a file below `preferred` if there is one there.
std::optional<CompileHelp> compile_help(const std::string& log, const std::string& preferred);

} // namespace rt::tutor
