// A hash of texts, to see whether files have changed: Fowler, Noll and Vo, 64 bits, variant 1a.
#pragma once

#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>

namespace rt {

class Hash {
  public:
    void add(std::string_view bytes) {
        for (const char c : bytes) state = (state ^ std::uint8_t(c)) * 0x100000001b3u;
        state = (state ^ 0x100) * 0x100000001b3u; // an end, so that "a" "bc" is not "ab" "c"
    }
    /// 16 hexadecimal digits.
    std::string text() const {
        char digits[17];
        std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(state));
        return digits;
    }

  private:
    std::uint64_t state = 0xcbf29ce484222325u;
};

} // namespace rt
