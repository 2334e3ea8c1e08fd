// Where one character of UTF-8 ends and the next begins.
#pragma once

#include <cstddef>
#include <string_view>

namespace rt {

/// Returns the number of bytes of the UTF-8 character at the front of `text`, which is not empty, or 0 if
/// there is none (RFC 3629: no surrogates, nothing in more bytes than it needs).
std::size_t character_length(std::string_view text);

} // namespace rt
