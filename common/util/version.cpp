// The version. CMake defines it for this file alone, so that a new one recompiles nothing else.
#include "common/util/version.h"

namespace rt {

const char* version() {
    return "Raysteps " RT_VERSION;
}

} // namespace rt
