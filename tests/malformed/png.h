// Builds PNG files of any bit depth and colour type by hand, so that they can be malformed as well.
#pragma once

#include <cstdint>
#include <string>
#include <utility>

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

/// Returns a zlib stream without compression (RFC 1950 and 1951): one stored block of less than 64 KB.
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

/// Returns a zlib stream of about 258 * `runs` zeros in 13 bits each: fixed codes, length 258, distance 1.
inline std::string zeros(int runs) {
    std::string bytes("\x78\x01", 2);
    unsigned pending = 0;
    int count = 0;
    const auto add = [&](unsigned value, int bits) { // a Huffman code's first bit goes to the lowest position
        for (int i = bits - 1; i >= 0; --i) {
            pending |= (value >> i & 1) << count % 8;
            if (++count % 8 == 0) bytes += char(std::exchange(pending, 0));
        }
    };
    add(0b110, 3);      // the last block, of fixed codes
    add(0b00110000, 8); // a zero
    for (int i = 0; i < runs; ++i) add(0b1100010100000, 13);
    add(0, 16); // the end, and padding to a whole byte
    return bytes;
}

/// Returns a PNG whose data are compressed already, with further chunks before them. Colour types: 0 grey, 2
/// RGB, 3 palette, 4 grey and alpha, 6 RGBA.
inline std::string packed_png(std::uint32_t width, std::uint32_t height, int depth, int colour_type,
                              const std::string& data, const std::string& chunks = "") {
    const std::string header =
        big_endian(width) + big_endian(height) + char(depth) + char(colour_type) + std::string(3, '\0');
    return "\x89PNG\r\n\x1a\n" + chunk("IHDR", header) + chunks + chunk("IDAT", data) + chunk("IEND", "");
}

/// Returns a PNG. `rows`: each row's samples after a filter byte of 0.
inline std::string png(std::uint32_t width, std::uint32_t height, int depth, int colour_type,
                       const std::string& rows, const std::string& chunks = "") {
    return packed_png(width, height, depth, colour_type, stored(rows), chunks);
}

} // namespace rt::malformed
