// A PNG file made by hand, of any bit depth and colour type, and so also a wrong one.
#pragma once

#include <cstdint>
#include <string>

namespace rt::malformed {

inline std::string big_endian(std::uint32_t value) {
    return {char(value >> 24), char(value >> 16), char(value >> 8), char(value)};
}

inline std::uint32_t crc(const std::string& bytes) {
    std::uint32_t sum = 0xffffffffu;
    for (const char byte : bytes) {
        sum ^= std::uint8_t(byte);
        for (int i = 0; i < 8; ++i) sum = sum >> 1 ^ (sum & 1 ? 0xedb88320u : 0);
    }
    return ~sum;
}

inline std::string chunk(const std::string& kind, const std::string& data) {
    return big_endian(std::uint32_t(data.size())) + kind + data + big_endian(crc(kind + data));
}

/// zlib without compression (RFC 1950 and 1951): one stored block of less than 64 KB.
inline std::string stored(const std::string& data) {
    std::uint32_t a = 1, b = 0;
    for (const char byte : data) {
        a = (a + std::uint8_t(byte)) % 65521;
        b = (b + a) % 65521;
    }
    const char low = char(data.size()), high = char(data.size() >> 8);
    return std::string("\x78\x01\x01") + low + high + char(~low) + char(~high) + data +
           big_endian(b << 16 | a);
}

/// `rows`: each row's samples behind a filter byte of 0. Colour type 0 grey, 2 RGB, 4 grey and alpha, 6 RGBA.
inline std::string png(std::uint32_t width, std::uint32_t height, int depth, int colour_type,
                       const std::string& rows) {
    const std::string header =
        big_endian(width) + big_endian(height) + char(depth) + char(colour_type) + std::string(3, '\0');
    return "\x89PNG\r\n\x1a\n" + chunk("IHDR", header) + chunk("IDAT", stored(rows)) + chunk("IEND", "");
}

} // namespace rt::malformed
