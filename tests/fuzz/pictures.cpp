// Fuzz targets for images: files that stb_image and libjpeg decode, and Radiance .hdr in memory.
#include "common/util/file_bytes.h"
#include "common/image/hdr_format.h"
#include "common/image/image_file.h"
#include "common/model/obj/mask.h"
#include "tests/fuzz/fuzz.h"

namespace rt::fuzz {

namespace {

/// Fills the stack of the next call, so that a decoder that reads uninitialised memory changes its result.
[[gnu::noinline]] void fill_stack(unsigned char value) {
    volatile unsigned char bytes[1 << 15];
    for (volatile unsigned char& byte : bytes) byte = value;
}

/// Returns an empty bitmap if the file is rejected, or if it has so many pixels that it takes seconds without
/// testing anything more than a smaller one.
Bitmap decoded(const std::string& path, unsigned char stack) {
    constexpr std::int64_t most = 1 << 20;
    Bitmap bitmap;
    fill_stack(stack);
    refusal([&] { bitmap = read_bitmap(path, most); });
    return bitmap;
}

void check_bitmap(const Bitmap& bitmap, std::size_t pixels) {
    require(bitmap.values.size() == 3 * pixels, "a bitmap has three values for each pixel");
    require(bitmap.opacity.empty() || bitmap.opacity.size() == pixels,
            "either each pixel has an opacity or none");
    require(bitmap.flaw.find('\n') == std::string::npos, "a flaw is one line");
    const Mask mask = mask_of(bitmap);
    require(mask.opacity.size() == std::size_t(mask.width) * std::size_t(mask.height), "a mask is complete");
    Bitmap filled = bitmap;
    fill_hidden_colours(filled);
    require(filled.values.size() == bitmap.values.size(), "hidden colours are filled in place");
}

/// Reads the image in `path`, writes it as a PNG, and returns the bytes of that file.
std::string written_again(const std::string& path, const std::string& name) {
    write_image(folder() + "/" + name, read_image(path));
    return read_file(folder() + "/" + name);
}

/// Checks an image file. Only for TGA does the file name determine the format.
void check_picture(const std::string& path) {
    const Bitmap bitmap = decoded(path, 0x55);
    require(decoded(path, 0xaa).values == bitmap.values, "an image depends only on its bytes");
    const std::size_t pixels = std::size_t(bitmap.width) * std::size_t(bitmap.height);
    check_bitmap(bitmap, pixels);
    if (pixels == 0 || pixels > 1024 || !bitmap.flaw.empty()) return;
    const std::string once = written_again(path, "once.png");
    require(written_again(folder() + "/once.png", "twice.png") == once,
            "a PNG that was read is written unchanged");
}

} // namespace

void run_picture(std::string_view bytes) {
    check_picture(write_input("picture.png", bytes));
}

void run_tga(std::string_view bytes) {
    check_picture(write_input("picture.tga", bytes));
}

void run_hdr(std::string_view bytes) {
    Image image;
    if (!refusal([&] { image = decode_hdr(bytes); }).empty()) return;
    require(image.pixels.size() == std::size_t(image.width) * std::size_t(image.height),
            "no pixel is missing");
    for (const vec3& pixel : image.pixels)
        require(is_finite(pixel) && pixel.x >= 0 && pixel.y >= 0 && pixel.z >= 0,
                "light is finite and not negative");
    const std::string once = encode_hdr(image);
    const Image again = decode_hdr(once);
    require(again.width == image.width && again.height == image.height, "a picture keeps its size");
    require(encode_hdr(again) == once, "an .hdr that was read is written unchanged");
}

} // namespace rt::fuzz
