// Encodes and decodes Radiance .hdr files in memory.
// This is our own code, because stb_image 2.27 never returns from a truncated file, and because
// stb_image_write truncates mantissas instead of rounding them, which darkens every image.
#include "common/image/hdr_format.h"

#include "common/util/error.h"
#include "common/util/text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <sstream>
#include <vector>

namespace rt {
namespace {

constexpr int shortest_run = 4; // a shorter run saves nothing
// A count byte of 1 to 128 is followed by that many literal bytes; 129 to 255 means a run of 1 to 127.
constexpr int longest_packet = 127;
constexpr int least_rle_width = 8, least_flat_width = 1 << 15; // rows of other widths are stored uncompressed

bool is_rle_width(int width) {
    return width >= least_rle_width && width < least_flat_width;
}

// ---- encode

int run_length(const std::uint8_t* at, const std::uint8_t* end) {
    const std::uint8_t* stop = std::min(at + longest_packet, end);
    return int(std::find_if(at, stop, [at](std::uint8_t byte) { return byte != *at; }) - at);
}

/// Appends one channel of one row: runs of equal bytes, and stretches of other bytes as literals.
void encode_channel(const std::vector<std::uint8_t>& channel, std::string& out) {
    const std::uint8_t* at = channel.data();
    const std::uint8_t* const end = at + channel.size();
    while (at < end) {
        const std::uint8_t* stretch = at;
        while (at < end && at - stretch < longest_packet && run_length(at, end) < shortest_run) ++at;
        if (at > stretch) {
            out += char(at - stretch);
            out.append(reinterpret_cast<const char*>(stretch), std::size_t(at - stretch));
        }
        const int run = at < end ? run_length(at, end) : 0;
        if (run < shortest_run) continue;
        out += char(128 + run);
        out += char(*at);
        at += run;
    }
}

void encode_row(const std::vector<Rgbe>& row, std::string& out) {
    if (!is_rle_width(int(row.size()))) {
        for (const Rgbe& pixel : row) out.append(pixel.begin(), pixel.end());
        return;
    }
    out += {2, 2, char(row.size() >> 8), char(row.size() & 255)};
    std::vector<std::uint8_t> channel(row.size());
    for (std::size_t c = 0; c < 4; ++c) {
        std::transform(row.begin(), row.end(), channel.begin(), [c](const Rgbe& pixel) { return pixel[c]; });
        encode_channel(channel, out);
    }
}

// ---- decode

/// The bytes that have not been read yet.
struct Reader {
    std::string_view rest;

    std::uint8_t byte() {
        if (rest.empty()) throw Error("is cut short");
        const std::uint8_t value = std::uint8_t(rest.front());
        rest.remove_prefix(1);
        return value;
    }
    Rgbe pixel() {
        Rgbe value{};
        for (std::uint8_t& part : value) part = byte();
        return value;
    }
    std::string_view line() {
        const std::size_t end = rest.find('\n');
        if (end == std::string_view::npos) throw Error("is cut short or not a Radiance .hdr file");
        std::string_view text = rest.substr(0, end);
        rest.remove_prefix(end + 1);
        if (!text.empty() && text.back() == '\r') text.remove_suffix(1);
        return text;
    }
};

int size_after(std::string_view& text, std::string_view name) {
    int size = 0;
    if (text.substr(0, name.size()) == name) {
        text.remove_prefix(name.size());
        const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), size);
        text.remove_prefix(failure == std::errc() ? std::size_t(end - text.data()) : 0);
        size = failure == std::errc() ? size : 0;
    }
    if (size <= 0)
        throw Error("states no size of the form \"-Y height +X width\" (other orders are not supported)");
    return size;
}

/// The factor that the image's pixels were multiplied by, according to its header.
struct Exposure {
    vec3 factor{1.0f};

    /// Applies `line` if it has the form "EXPOSURE= 2" or "COLORCORR= 1 .9 1".
    void follow(std::string_view line) {
        const bool is_colour = line.substr(0, 10) == "COLORCORR=";
        if (!is_colour && line.substr(0, 9) != "EXPOSURE=") return;
        std::istringstream numbers(std::string(line.substr(line.find('=') + 1)));
        vec3 further(0.0f);
        numbers >> further.x;
        further = vec3(further.x);
        if (is_colour) numbers >> further.y >> further.z;
        factor *= further;
        const auto is_sound = [](float f) { return f > 1e-20f && f < 1e20f; };
        if (numbers.fail() || !is_sound(factor.x) || !is_sound(factor.y) || !is_sound(factor.z))
            throw Error("has an invalid line " + in_quotes(line));
    }
    vec3 undone(vec3 colour) const { return min(colour / factor, vec3(std::numeric_limits<float>::max())); }
};

/// Reads the header and returns a black image of the size that it states.
Image decode_header(Reader& reader, std::int64_t pixels_left, Exposure& exposure) {
    const std::string_view magic = reader.line();
    if (magic != "#?RADIANCE" && magic != "#?RGBE") throw Error("is not a Radiance .hdr file");
    for (std::string_view line = reader.line(); !line.empty(); line = reader.line()) {
        exposure.follow(line);
        if (line.substr(0, 7) == "FORMAT=" && line != "FORMAT=32-bit_rle_rgbe")
            throw Error("has a pixel format other than 32-bit_rle_rgbe");
    }
    std::string_view size = reader.line();
    const int height = size_after(size, "-Y ");
    const int width = size_after(size, " +X ");
    if (const std::string why = size_error(width, height, pixels_left); !why.empty()) throw Error(why);
    // A run encodes at most 127 values in two bytes, so a small file cannot claim a large image.
    if (reader.rest.size() / 2 < std::size_t(width) * std::size_t(height) * 4 / 128)
        throw Error("is cut short");
    return Image(width, height);
}

void decode_channel(Reader& reader, std::vector<Rgbe>& row, std::size_t channel) {
    for (std::size_t x = 0; x < row.size();) {
        const int code = reader.byte();
        const std::size_t count = std::size_t(code > 128 ? code - 128 : code);
        if (count == 0 || x + count > row.size())
            throw Error("is damaged (a run goes past the end of its row)");
        std::uint8_t value = 0;
        for (std::size_t i = 0; i < count; ++i, ++x) {
            if (code <= 128 || i == 0) value = reader.byte();
            row[x][channel] = value;
        }
    }
}

void decode_row(Reader& reader, std::vector<Rgbe>& row) {
    const std::size_t width = row.size();
    const std::string_view mark = reader.rest.substr(0, 4);
    const bool rle = is_rle_width(int(width)) && mark.size() == 4 && mark[0] == 2 && mark[1] == 2 &&
                     std::uint8_t(mark[2]) < 128;
    if (!rle) {
        for (Rgbe& pixel : row) pixel = reader.pixel();
        return;
    }
    if (std::size_t(std::uint8_t(mark[2]) << 8 | std::uint8_t(mark[3])) != width)
        throw Error("is damaged (a row has the wrong width)");
    reader.rest.remove_prefix(4);
    for (std::size_t channel = 0; channel < 4; ++channel) decode_channel(reader, row, channel);
}

} // namespace

Rgbe rgbe_from_linear(vec3 colour) {
    const float largest_value = std::ldexp(255.0f, 255 - 136);
    const vec3 kept = glm::clamp(colour, vec3(0.0f), vec3(largest_value));
    const float largest = std::max({kept.x, kept.y, kept.z});
    int exponent = 0;
    std::frexp(largest, &exponent);                              // largest = f * 2^exponent, f in [1/2, 1)
    if (std::ldexp(largest, 8 - exponent) >= 255.5f) ++exponent; // the mantissa would round to 256
    if (largest == 0 || exponent + 128 < 1) return {0, 0, 0, 0};
    const auto mantissa = [&](float value) { return std::uint8_t(std::ldexp(value, 8 - exponent) + 0.5f); };
    return {mantissa(kept.x), mantissa(kept.y), mantissa(kept.z), std::uint8_t(exponent + 128)};
}

vec3 linear_from_rgbe(Rgbe rgbe) {
    return rgbe[3] == 0 ? vec3(0.0f) : vec3(rgbe[0], rgbe[1], rgbe[2]) * std::ldexp(1.0f, rgbe[3] - 136);
}

std::string encode_hdr(const Image& image) {
    std::string out = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y " + std::to_string(image.height) + " +X " +
                      std::to_string(image.width) + "\n";
    std::vector<Rgbe> row(std::size_t(image.width));
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) row[std::size_t(x)] = rgbe_from_linear(visible(image(x, y)));
        encode_row(row, out);
    }
    return out;
}

Image decode_hdr(std::string_view bytes, std::int64_t pixels_left) {
    Reader reader{bytes};
    Exposure exposure;
    Image image = decode_header(reader, pixels_left, exposure);
    std::vector<Rgbe> row(std::size_t(image.width));
    for (int y = 0; y < image.height; ++y) {
        decode_row(reader, row);
        for (int x = 0; x < image.width; ++x)
            image(x, y) = exposure.undone(linear_from_rgbe(row[std::size_t(x)]));
    }
    return image;
}

} // namespace rt
