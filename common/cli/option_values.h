// The values of options as typed: parsed, compared with their range, and refused in one sentence.
#pragma once

#include "common/math/vec.h"
#include "common/render/settings.h"

#include <string>
#include <vector>

namespace rt {

inline constexpr int max_image_dimension =
    65536; ///< of the whole image; only the crop is limited to max_dimension

/// Returns a number as --help prints it.
template <typename Number>
std::string text_of(Number value);

/// Returns the decimal number that all of `text` spells. Throws Error if it is not in [low, high].
template <typename Number>
Number parse_number(const std::string& name, const std::string& text, Number low, Number high);

/// Returns the three finite numbers of "0,1.5,-2". Throws Error if it is anything else.
dvec3 parse_vector(const std::string& name, const std::string& text);

/// Returns the index of `text` among `names`. Throws Error, with a suggestion, if it is not there.
int parse_choice(const std::string& name, const std::string& text, const std::vector<std::string>& names);

/// Returns the part "x0,y0,x1,y1" of an image. Throws Error if it is not inside the image.
Crop parse_crop(const std::string& text, int width, int height);

/// Returns the names as one sentence: "one of a, b, c".
std::string one_of(const std::vector<std::string>& names);

} // namespace rt
