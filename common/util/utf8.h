// Finds the boundaries of UTF-8 characters.
#pragma once

#include <cstddef>
#include <string_view>

namespace rt {

/// Returns the number of bytes of the UTF-8 character at the front of `text`, which is not empty, or 0 if it
/// is not valid UTF-8 (RFC 3629: no surrogates, no overlong forms).
std::size_t character_length(std::string_view text);

} // namespace rt
