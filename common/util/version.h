// The version of Raysteps.
#pragma once

namespace rt {

/// Returns the text that --version prints, as in "Raysteps 1.0.0". CMakeLists.txt defines the number.
const char* version();

} // namespace rt
