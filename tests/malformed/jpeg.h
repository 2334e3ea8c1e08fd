// Builds JPEG files of flat 8 x 8 squares by hand, so that they can be malformed as well.
#pragma once

#include <cstdint>
#include <string>

namespace rt::malformed {

/// A bit stream, most significant bit first, with a 0 after each byte of 255 (ITU T.81, B.1.1.5).
struct JpegBits {
    std::string bytes;
    unsigned pending = 0;
    int count = 0;

    void add(unsigned value, int bits) {
        for (int i = bits - 1; i >= 0; --i) {
            pending = pending << 1 | (value >> i & 1);
            if (++count % 8 != 0) continue;
            bytes += char(pending & 255);
            if ((pending & 255) == 255) bytes += '\0';
        }
    }
    /// Appends the difference to the previous square's mean: the number of its bits, as a
    /// code of four, and these bits.
    void add_difference(int difference) {
        int bits = 0;
        while (difference >> bits != 0 && difference >> bits != -1) ++bits;
        if (difference < 0 && -difference == 1 << bits) ++bits;
        add(unsigned(bits), 4);
        add(unsigned(difference < 0 ? difference + (1 << bits) - 1 : difference), bits);
    }
};

inline std::string jpeg_segment(int marker, const std::string& data) {
    const std::size_t length = data.size() + 2;
    return std::string{'\xff', char(marker), char(length >> 8), char(length)} + data;
}

struct JpegKind {
    bool progressive = false;
    bool adobe = false; ///< the values are not YCbCr, and CMYK values are inverted
};

/// Returns a JPEG file. `values`: those of each square, one per channel, row by row.
inline std::string jpeg(int width, int height, int channels, const std::string& values, JpegKind kind = {}) {
    std::string frame{8, char(height >> 8), char(height), char(width >> 8), char(width), char(channels)};
    std::string scan{char(channels)};
    for (int c = 1; c <= channels; ++c) {
        frame += {char(c), '\x11', '\0'};
        scan += {char(c), '\0'};
    }
    scan += {'\0', char(kind.progressive ? 0 : 63), '\0'};
    JpegBits bits;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const int before = i < std::size_t(channels) ? 128 : std::uint8_t(values[i - std::size_t(channels)]);
        bits.add_difference(8 * (std::uint8_t(values[i]) - before));
        if (!kind.progressive) bits.add(0, 1); // only the mean
    }
    while (bits.count % 8 != 0) bits.add(1, 1);
    std::string means_table{'\0', '\0', '\0', '\0', 12}, end_table{'\x10', 1};
    means_table += std::string(12, '\0') + std::string("\0\1\2\3\4\5\6\7\x8\x9\xa\xb", 12);
    end_table += std::string(16, '\0');
    return "\xff\xd8" + (kind.adobe ? jpeg_segment(0xee, std::string("Adobe\0\x64\0\0\0\0\0", 12)) : "") +
           jpeg_segment(0xdb, '\0' + std::string(64, '\1')) +
           jpeg_segment(kind.progressive ? 0xc2 : 0xc0, frame) + jpeg_segment(0xc4, means_table) +
           jpeg_segment(0xc4, end_table) + jpeg_segment(0xda, scan) + bits.bytes + "\xff\xd9";
}

} // namespace rt::malformed
