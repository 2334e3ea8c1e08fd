// The options of step 07 and later: how the samples of a pixel are placed and weighted, and the lens.
#pragma once

#include "07_antialias/filter.h"
#include "07_antialias/sampler.h"
#include "07_antialias/thin_lens.h"
#include "common/cli/options.h"

namespace rt {

/// Declares --sampler.
inline Choice<SamplerKind> sampler_option(Options& options) {
    return options.choice(
        "sampler", {"random", "stratified", "sobol"}, SamplerKind::sobol,
        "how the samples of a pixel are placed: independently, one per cell, or as Sobol points, "
        "which are stratified in cells of every shape");
}

/// Declares --filter and --filter-width.
struct FilterOptions {
    explicit FilterOptions(Options& options)
        : filter(options.choice("filter", {"box", "tent", "gaussian"}, Filter::gaussian,
                                "how a pixel weights the light around its centre")),
          width(options.option("filter-width", 1.0f, 0.0f, 10.0f,
                               "scales the filter: box 1 pixel wide, tent 2, Gaussian sigma 1/2")) {}

    Choice<Filter> filter;
    const float& width;
};

/// Declares --aperture and --focus.
struct LensOptions {
    explicit LensOptions(Options& all)
        : options(all),
          aperture(all.option("aperture", 0.0f, 0.0f, 1000.0f,
                              "diameter of the lens, metres; 0: a pinhole, with everything in focus; "
                              "if not given, that of the scene")),
          focus(all.option("focus", 0.0f, 0.0f, 1e6f,
                           "distance of the plane in focus, metres; 0: the distance to --at")) {}

    /// Returns `other`, overridden by the options given on the command line. A focus of 0 means the distance
    /// to the point that the camera looks at.
    ThinLens lens(const LookAt& look_at,
                  const ThinLens& other = {.aperture_diameter = 0, .focus_distance = 0}) const {
        const float width = options.is_set("aperture") ? aperture : other.aperture_diameter;
        const float ahead = options.is_set("focus") ? focus : other.focus_distance;
        return {width, ahead > 0 ? ahead : distance(look_at.from, look_at.at)};
    }

    const Options& options;
    const float& aperture;
    const float& focus;
};

} // namespace rt
