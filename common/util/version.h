// Which version of Raysteps this is.
#pragma once

namespace rt {

/// Returns "Raysteps 1.0.0" and the like, which every --version prints. The number is stated in CMakeLists.txt.
const char* version();

} // namespace rt
