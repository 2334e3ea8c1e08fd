// Pictures: PNG (and JPEG where it is read) from a file, and Radiance's .hdr in memory.
#include "common/file_bytes.h"
#include "common/hdr_format.h"
#include "common/image_file.h"
#include "tests/fuzz/fuzz.h"

#define STBI_NO_STDIO
#include <stb_image.h>

#include <cmath>
#include <cstdint>

namespace rt::fuzz {

namespace {

/// A picture of many pixels takes seconds under sanitizers, and shows nothing that a small one does not.
bool is_large(std::string_view bytes) {
    int width = 0, height = 0, channels = 0;
    const auto* first = reinterpret_cast<const stbi_uc*>(bytes.data());
    return stbi_info_from_memory(first, int(bytes.size()), &width, &height, &channels) != 0 &&
           std::int64_t(width) * height > 1 << 20 && size_problem(width, height).empty();
}

/// Fills the part of the stack that the next call uses: memory that a decoder reads before it writes shows.
[[gnu::noinline]] void fill_stack(unsigned char value) {
    volatile unsigned char bytes[1 << 15];
    for (volatile unsigned char& byte : bytes) byte = value;
}

Bitmap decoded(const std::string& path, unsigned char stack) {
    Bitmap bitmap;
    fill_stack(stack);
    refusal([&] { bitmap = read_bitmap(path); });
    return bitmap;
}

/// The bytes of the PNG that holds what the picture in `path` shows.
std::string written_again(const std::string& path, const std::string& name) {
    write_image(folder() + "/" + name, read_image(path));
    return read_file(folder() + "/" + name);
}

} // namespace

void run_picture(std::string_view bytes) {
    if (is_large(bytes)) return;
    const std::string path = write_input("picture.png", bytes);
    const Bitmap bitmap = decoded(path, 0x55);
    require(decoded(path, 0xaa).values == bitmap.values, "a picture depends on its bytes alone");
    const std::size_t pixels = std::size_t(bitmap.width) * std::size_t(bitmap.height);
    require(bitmap.values.size() == 3 * pixels, "a bitmap has three values for each pixel");
    if (pixels == 0 || pixels > 1024) return;
    const std::string once = written_again(path, "once.png");
    require(written_again(folder() + "/once.png", "twice.png") == once, "a PNG is written as it was read");
}

void run_hdr(std::string_view bytes) {
    Image image;
    if (!refusal([&] { image = decode_hdr(bytes); }).empty()) return;
    require(image.pixels.size() == std::size_t(image.width) * std::size_t(image.height),
            "every pixel is there");
    for (const vec3& pixel : image.pixels)
        require(is_finite(pixel) && pixel.x >= 0 && pixel.y >= 0 && pixel.z >= 0,
                "light is finite and not negative");
    const std::string once = encode_hdr(image);
    const Image again = decode_hdr(once);
    require(again.width == image.width && again.height == image.height, "a picture keeps its size");
    require(encode_hdr(again) == once, "an .hdr is written as it was read");
}

} // namespace rt::fuzz
