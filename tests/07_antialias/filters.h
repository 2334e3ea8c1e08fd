// What the checks of filters and pixels share: all filters and their names.
#pragma once

#include "07_antialias/filter.h"

#include <array>
#include <string>

namespace rt {

inline const std::array filters{Filter::box, Filter::tent, Filter::gaussian};

inline std::string name(Filter filter) {
    return filter == Filter::box ? "box" : filter == Filter::tent ? "tent" : "gaussian";
}

} // namespace rt
