// Included before a step's main.cpp, after tools/trace/traced.h: hands each ray of the traced sample to the page.
#pragma once

#include "site/twins/page.h"
#include "tools/trace/traced.h"

extern "C" RT_PAGE_HAS(ray) void page_ray(float x0, float y0, float z0, float x1, float y1, float z1, int met,
                                          int depth);

namespace rt::trace {

inline const bool drawn = [] {
    draw = [](vec3 from, vec3 to, Met met) {
        page_ray(from.x, from.y, from.z, to.x, to.y, to.z, int(met), depth);
    };
    return true;
}();

} // namespace rt::trace

/// Makes the next sample the one that is told.
RT_PAGE_CALLS(tell_next_sample) void tell_next_sample() {
    rt::trace::samples = 0;
    rt::trace::depth = 0;
}
