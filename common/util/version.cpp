// The version, which CMake defines for this file alone: a new one recompiles nothing else.
#include "common/util/version.h"

namespace rt {

const char* version() {
    return "Raysteps " RT_VERSION;
}

} // namespace rt
