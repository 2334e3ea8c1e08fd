// Reads and writes image files as linear light: PNG through stb, .hdr through our own code.
#include "common/image/image_file.h"

#include "common/util/error.h"
#include "common/util/file_bytes.h"
#include "common/util/paths.h"
#include "common/image/hdr_format.h"

#define STBI_WRITE_NO_STDIO
#include <stb_image_write.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <filesystem>

namespace rt {
namespace {

std::string lower_ending(const std::string& path) {
    std::string ending = text_of(path_of(path).extension());
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](unsigned char c) { return char(std::tolower(c)); });
    return ending;
}

void check_ending(const std::string& path) {
    const std::string ending = lower_ending(path);
    if (ending != ".png" && ending != ".hdr")
        throw Error(path + ": the name should end in .png or .hdr" +
                    (ending.empty() ? "" : " (" + ending + " is not supported)"));
}

std::uint8_t srgb_code(float linear) {
    const float clamped = std::clamp(linear, 0.0f, 1.0f);
    return std::uint8_t(srgb_from_linear(clamped) * 255.0f + 0.5f);
}

/// The inverse of srgb_from_linear, for each of the 65536 values of a Bitmap (IEC 61966-2-1).
std::vector<float> linear_table() {
    std::vector<float> table(65536);
    for (std::size_t code = 0; code < table.size(); ++code) {
        const double srgb = double(code) / 65535;
        table[code] = float(srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4));
    }
    return table;
}

std::string encode_png(const std::string& path, const Image& image) {
    std::vector<std::uint8_t> codes;
    codes.reserve(image.pixels.size() * 3);
    for (const vec3& pixel : image.pixels) {
        const vec3 colour = visible(pixel);
        for (int channel = 0; channel < 3; ++channel) codes.push_back(srgb_code(colour[channel]));
    }
    std::string bytes;
    const auto append = [](void* context, void* data, int size) {
        static_cast<std::string*>(context)->append(static_cast<const char*>(data), std::size_t(size));
    };
    if (!stbi_write_png_to_func(append, &bytes, image.width, image.height, 3, codes.data(), image.width * 3))
        throw Error(path + ": the image could not be encoded; is there too little memory?");
    return bytes;
}

Image decode_linear(const std::string& path, const std::string& bytes) {
    try {
        return decode_hdr(bytes);
    } catch (const Error& problem) {
        throw Error(path + ": " + problem.what());
    }
}

} // namespace

std::string size_error(int width, int height, std::int64_t pixels_left) {
    const std::string size = std::to_string(width) + " x " + std::to_string(height);
    const auto millions = [](std::int64_t pixels) { return std::to_string(pixels / 1'000'000) + " million"; };
    const std::int64_t pixels = std::int64_t(width) * height;
    if (width < 1 || height < 1) return "has no pixels (" + size + ")";
    if (width > max_dimension || height > max_dimension)
        return "is too large (" + size + ", at most " + std::to_string(max_dimension) + " per side)";
    if (pixels > max_pixels)
        return "is too large (" + size + ", at most " + millions(max_pixels) + " pixels)";
    if (pixels > pixels_left)
        return "is too large (" + size + ": all textures of a model may have " +
               millions(max_texture_pixels) + " pixels together, or 2 GB, and " + millions(pixels_left) +
               " are left)";
    return "";
}

void check_writable(const std::string& path) {
    check_ending(path);
    check_file_writable(path);
}

void write_image(const std::string& path, const Image& image) {
    check_ending(path);
    if (const std::string why = size_error(image.width, image.height); !why.empty())
        throw Error(path + ": the image " + why);
    write_file(path, lower_ending(path) == ".png" ? encode_png(path, image) : encode_hdr(image));
}

std::size_t memory_to_write(int width, int height) {
    // A PNG pixel takes 3 bytes as sRGB codes, 3 filtered, and up to 9 where stb's compressed copy grows. Its
    // hash table takes some MB.
    return std::size_t(width) * std::size_t(height) * 16 + (std::size_t(8) << 20);
}

Image read_image(const std::string& path) {
    if (lower_ending(path) == ".hdr") return decode_linear(path, read_file(path, max_file_bytes));
    const Bitmap bitmap = read_bitmap(path);
    if (!bitmap.flaw.empty()) throw Error(path + ": " + bitmap.flaw);
    static const std::vector<float> linear = linear_table();
    Image image(bitmap.width, bitmap.height);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        const std::uint16_t* const value = &bitmap.values[3 * i];
        image.pixels[i] = {linear[value[0]], linear[value[1]], linear[value[2]]};
    }
    return image;
}

std::string absolute_path(const std::string& path) {
    std::error_code ignored;
    const std::filesystem::path whole = std::filesystem::absolute(path_of(path), ignored);
    return ignored ? path : text_of(whole.lexically_normal());
}

} // namespace rt
