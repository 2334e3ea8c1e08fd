// Facts about image files: round trips, error messages for damaged files, and the safety of existing files.
#include "common/image/image_file.h"
#include "common/util/paths.h"

#include "common/util/error.h"
#include "common/util/file_bytes.h"
#include "common/image/hdr_format.h"
#include "tests/check.h"
#include "tests/malformed/folder.h"
#include "tests/malformed/jpeg.h"
#include "tests/malformed/png.h"
#include "tests/posix.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <random>

using namespace rt;
using namespace rt::malformed;

namespace {

Image uniform(int width, int height, vec3 colour) {
    Image image(width, height);
    for (vec3& pixel : image.pixels) pixel = colour;
    return image;
}

Image gradient(int width, int height) {
    Image image(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x)
            image(x, y) = vec3(float(x) + 0.1f, float(y) * 0.01f, float(x % 7)) / float(width);
    }
    return image;
}

/// Returns the error of reading a file with these bytes.
std::string error_of_reading(const Folder& folder, const std::string& name, const std::string& bytes) {
    const std::string path = folder.write(name, bytes);
    return error_of([&] { read_image(path); });
}

std::string hdr(const std::string& size, const std::string& data) {
    return "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n" + size + "\n" + data;
}

} // namespace

// ---- sRGB

TEST_CASE("a PNG's 8-bit value 128 is linear .2158605 and not 128/255 to the power 2.2") {
    const Folder folder;
    const std::string path = folder.write("grey.png", png(1, 1, 8, 2, std::string("\0\x80\xff\x00", 4)));
    const vec3 pixel = read_image(path)(0, 0);
    CHECK(pixel == approx(vec3(0.2158605f, 1, 0), 1e-6f));
}

TEST_CASE("all bits of a 16-bit PNG are decoded") {
    const Folder folder; // 32768 and 1311 of 65535: .500008 and .020005
    const std::string path = folder.write("deep.png", png(2, 1, 16, 0, std::string("\0\x80\x00\x05\x1f", 5)));
    const Image image = read_image(path);
    CHECK(image(0, 0) == approx(vec3(0.2140411f), 1e-5f));
    CHECK(image(1, 0).x == approx(0.0015480f, 1e-6f));
    CHECK(read_bitmap(path).values[0] == 32768);
    CHECK(read_bitmap(path).values[3] == 1311);
}

TEST_CASE("every 8-bit value is unchanged by decoding, encoding, writing and reading") {
    const Folder folder;
    std::string row(1, '\0');
    for (int code = 0; code < 256; ++code) row += std::string(3, char(code));
    const std::string first = folder.write("first.png", png(256, 1, 8, 2, row));
    write_image(folder / "second.png", read_image(first));
    const Bitmap bitmap = read_bitmap(folder / "second.png");
    REQUIRE(bitmap.values.size() == 768);
    for (std::size_t code = 0; code < 256; ++code) CHECK(bitmap.values[3 * code + 1] == code * 257);
}

TEST_CASE("light is rounded to the nearest 8-bit value and clamped") {
    const Folder folder;
    Image image(5, 1);
    const auto linear = [](double code) { return float(std::pow((code / 255 + 0.055) / 1.055, 2.4)); };
    image(0, 0) = {linear(100.45), linear(100.55), linear(254.55)};
    image(1, 0) = {-1, 0, 7};
    image(2, 0) = {0.002f, 0.0001f, 0.0031308f}; // in the linear segment: 12.92 x
    image(3, 0) = vec3(0.5f);
    image(4, 0) = vec3(std::numeric_limits<float>::max());
    write_image(folder / "a.png", image);
    const std::vector<std::uint16_t> values = read_bitmap(folder / "a.png").values;
    const int codes[] = {100, 101, 255, 0, 0, 255, 7, 0, 10, 188, 188, 188, 255, 255, 255};
    REQUIRE(values.size() == 15);
    for (std::size_t i = 0; i < 15; ++i) CHECK(values[i] == codes[i] * 257);
}

TEST_CASE("grey is copied to all channels and rows run from the top") {
    const Folder folder;
    const std::string grey_alpha =
        folder.write("ga.png", png(1, 2, 8, 4, std::string("\0\x40\x00\0\x80\x01", 6)));
    const Bitmap bitmap = read_bitmap(grey_alpha);
    CHECK(bitmap.width == 1);
    CHECK(bitmap.height == 2);
    CHECK(bitmap.values == std::vector<std::uint16_t>{0x4040, 0x4040, 0x4040, 0x8080, 0x8080, 0x8080});
}

// ---- opacity

TEST_CASE("an alpha channel is opacity and a fully opaque picture has none") {
    const Folder folder;
    const auto opacity = [&](const std::string& bytes) {
        return read_bitmap(folder.write("a.png", bytes)).opacity;
    };
    using Values = std::vector<std::uint16_t>;
    CHECK(opacity(png(2, 1, 8, 4, std::string("\0\x40\x00\x80\x80", 5))) == Values{0, 0x8080});
    CHECK(opacity(png(1, 2, 16, 6, std::string("\0abcdef\x12\x34\0abcdef\xff\xff", 18))) ==
          Values{0x1234, 65535});
    CHECK(opacity(png(2, 1, 8, 4, std::string("\0\x40\xff\x80\xff", 5))).empty());
    CHECK_MESSAGE(opacity(png(2, 1, 8, 4, std::string("\0\x40\0\x80\0", 5))).empty(),
                  "programs that do not support alpha write 0 everywhere");
    const std::string two = chunk("PLTE", "abcdef") + chunk("tRNS", std::string("\0\x40", 2));
    CHECK(opacity(png(2, 1, 8, 3, std::string("\0\0\1", 3), two)) == Values{0, 0x4040});
    const std::string key = chunk("tRNS", std::string("\0\x40", 2)); // grey 64 is transparent
    CHECK(opacity(png(2, 1, 8, 0, std::string("\0\x40\x41", 3), key)) == Values{0, 65535});
}

// ---- palettes

TEST_CASE("a pixel whose index exceeds its palette is black and not uninitialised memory") {
    const Folder folder;
    const std::string path =
        folder.write("a.png", png(2, 1, 8, 3, std::string("\0\0\xff", 3), chunk("PLTE", "\x10\x20\x30")));
    CHECK(read_bitmap(path).values == std::vector<std::uint16_t>{0x1010, 0x2020, 0x3030, 0, 0, 0});
    const std::string none = folder.write("b.png", png(2, 1, 8, 3, std::string("\0\0\xff", 3)));
    CHECK_ERROR(error_of([&] { read_bitmap(none); }), "b.png", "damaged");
}

// ---- memory

TEST_CASE("no file takes more memory than its size can require") {
    const Folder folder;
    const std::string bomb = packed_png(8, 8, 8, 2, zeros(4000)); // a megabyte in 6.5 KB
    CHECK_ERROR(error_of_reading(folder, "bomb.png", bomb), "bomb.png", "more data");
    CHECK_ERROR(error_of_reading(folder, "empty.png", packed_png(9000, 9000, 8, 2, zeros(1))), "cut short");
    const std::string vast = png(8, 8, 8, 2, "").replace(33, 4, "\x7f\xff\xff\xff"); // the length of its data
    CHECK_ERROR(error_of_reading(folder, "vast.png", vast), "vast.png", "cut short");
    CHECK_ERROR(error_of_reading(folder, "none.png", packed_png(8, 8, 8, 2, "")), "no pixel data");
    const std::string split = packed_png(1, 1, 8, 0, stored(std::string("\0\x77", 2)), chunk("IDAT", ""));
    CHECK(read_bitmap(folder.write("split.png", split)).values[0] == 0x7777); // a chunk may be empty
}

TEST_CASE("an interlaced PNG is read although its rows take more bytes than its size suggests") {
    const Folder folder;
    std::string rows; // of the seven passes over 8 x 8 pixels
    for (const int width : {1, 1, 2, 2, 2, 4, 4, 4, 4, 4, 4, 8, 8, 8, 8}) {
        rows += '\0';
        rows.append(std::size_t(width), '\x44');
    }
    std::string bytes = png(8, 8, 8, 0, rows);
    bytes[28] = 1; // last byte of the header before its checksum
    CHECK(read_bitmap(folder.write("a.png", bytes)).values == std::vector<std::uint16_t>(192, 0x4444));
}

TEST_CASE("the limit on all textures of a model is reported in plain words") {
    CHECK(size_error(10'000, 10'000, 100'000'000).empty());
    CHECK_ERROR(size_error(10'000, 10'000, 99'999'999), "10000 x 10000", "all textures", "2 GB");
    const Folder folder;
    const std::string path = folder.write("a.png", png(2, 2, 8, 0, std::string(6, '\0')));
    CHECK_ERROR(error_of([&] { read_bitmap(path, 3); }), "a.png", "all textures");
    CHECK(read_bitmap(path, 4).values.size() == 12);
}

// ---- JPEG, TGA, BMP

TEST_CASE("a JPEG is read in grey, RGB, YCbCr and CMYK with one pass or several") {
    const Folder folder;
    const auto first = [&](const std::string& bytes) {
        const Bitmap bitmap = read_bitmap(folder.write("a.png", bytes)); // whatever its name
        CHECK(bitmap.flaw == "");
        CHECK(bitmap.values.size() == std::size_t(bitmap.width * bitmap.height * 3));
        return vec3(bitmap.values[0], bitmap.values[1], bitmap.values[2]) / 257.0f;
    };
    CHECK(first(jpeg(8, 8, 1, "\x50")) == vec3(80));
    CHECK(first(jpeg(5, 3, 1, "\x50", {.progressive = true})) == vec3(80));
    CHECK(first(jpeg(8, 8, 3, "\xc8\x64\x32", {.adobe = true})) == vec3(200, 100, 50));
    CHECK(first(jpeg(8, 8, 3, "\x64\x80\xc8")) ==
          approx(vec3(201, 49, 100), 0.03f)); // Cr is 72 above the middle
    CHECK(first(jpeg(8, 8, 4, "\xff\x80\x40\x80", {.adobe = true})) == approx(vec3(128, 64, 32), 0.01f));
    const Bitmap two = read_bitmap(folder.write("two.jpg", jpeg(16, 8, 1, "\x10\xf0")));
    CHECK(two.values[3 * 7] == 0x1010);
    CHECK(two.values[3 * 8] == 0xf0f0);
}

TEST_CASE("a truncated JPEG is read as far as possible and reports the flaw") {
    const Folder folder;
    std::string squares;
    for (int i = 0; i < 64; ++i) squares += char(i % 2 == 0 ? 0x20 : 0xe0);
    const std::string whole = jpeg(64, 64, 1, squares);
    const std::string path = folder.write("cut.jpg", whole.substr(0, whole.size() - 60));
    const Bitmap bitmap = read_bitmap(path);
    CHECK(bitmap.flaw == "is cut short");
    CHECK(bitmap.values[0] == 0x2020);
    CHECK_ERROR(error_of([&] { read_image(path); }), "cut.jpg", "cut short"); // useless for comparison
    for (std::size_t size = 3; size < 150; size += 7)
        CHECK_ERROR(error_of_reading(folder, "head.jpg", whole.substr(0, size)), "head.jpg");
}

TEST_CASE("a JPEG with too many pixels or passes is rejected") {
    const Folder folder;
    CHECK_ERROR(error_of_reading(folder, "a.jpg", jpeg(30'000, 8, 1, "\x50")), "a.jpg", "too large");
    CHECK_ERROR(error_of_reading(folder, "b.jpg", jpeg(16'384, 16'384, 1, "\x50")), "b.jpg", "too large");
}

namespace {

std::string little_endian(std::uint32_t value, int bytes) {
    std::string text;
    for (int i = 0; i < bytes; ++i, value >>= 8) text += char(value);
    return text;
}

std::string bmp(int width, int height, int bits, const std::string& palette, const std::string& rows) {
    const std::uint32_t offset = 54 + std::uint32_t(palette.size());
    return "BM" + little_endian(0, 8) + little_endian(offset, 4) + little_endian(40, 4) +
           little_endian(std::uint32_t(width), 4) + little_endian(std::uint32_t(height), 4) +
           little_endian(1, 2) + little_endian(std::uint32_t(bits), 2) + little_endian(0, 24) + palette +
           rows;
}

/// Returns a TGA file of type `kind`: 2 RGB, 3 grey, 10 RGB with run lengths. Rows run from the top.
std::string tga(int kind, int width, int height, int bits, const std::string& pixels) {
    return std::string{'\0', '\0', char(kind)} + little_endian(0, 9) +
           little_endian(std::uint32_t(width), 2) + little_endian(std::uint32_t(height), 2) + char(bits) +
           '\x20' + pixels;
}

} // namespace

TEST_CASE("a BMP is read from the bottom or the top; a colour beyond its palette is black") {
    const Folder folder;
    const auto values = [&](const std::string& bytes) {
        return read_bitmap(folder.write("a.bmp", bytes)).values;
    };
    using Values = std::vector<std::uint16_t>;
    const std::string rows = std::string("\x30\x20\x10\0\x60\x50\x40\0", 8); // blue, green, red, and padding
    CHECK(values(bmp(1, 2, 24, "", rows)) == Values{0x4040, 0x5050, 0x6060, 0x1010, 0x2020, 0x3030});
    CHECK(values(bmp(1, -2, 24, "", rows)) == Values{0x1010, 0x2020, 0x3030, 0x4040, 0x5050, 0x6060});
    const std::string one("\x30\x20\x10\0", 4);
    CHECK(values(bmp(2, 1, 8, one, std::string("\0\xff\0\0", 4))) == Values{0x1010, 0x2020, 0x3030, 0, 0, 0});
    CHECK_ERROR(error_of_reading(folder, "cut.bmp", bmp(1, 2, 24, "", rows.substr(0, 6))), "cut.bmp",
                "cut short");
    CHECK_ERROR(error_of_reading(folder, "vast.bmp", bmp(9000, 9000, 24, "", rows)), "vast.bmp", "cut short");
    const int least = std::numeric_limits<int>::min();
    CHECK_ERROR(error_of_reading(folder, "odd.bmp", bmp(1, least, 24, "", rows)), "odd.bmp");
}

TEST_CASE("a BMP is rejected if its pixels begin inside its header or are compressed") {
    const Folder folder;
    const auto changed = [](std::string bytes, std::size_t at, std::uint32_t value) {
        return bytes.replace(at, 4, little_endian(value, 4));
    };
    for (const int bits : {1, 4, 8, 24}) {
        const std::string whole = bmp(1, 1, bits, "", std::string(1100, '\1'));
        for (const std::uint32_t offset : {0u, 3u, 53u})
            CHECK_ERROR(error_of_reading(folder, "in.bmp", changed(whole, 10, offset)), "in.bmp",
                        "inside its header");
        CHECK_ERROR(error_of_reading(folder, "odd.bmp", changed(whole, 30, 0x80000000)), "odd.bmp");
    }
    const std::string old = "BM" + little_endian(0, 8) + little_endian(25, 4) + little_endian(12, 4) +
                            little_endian(1, 2) + little_endian(1, 2) + little_endian(1, 2) +
                            little_endian(8, 2) + std::string(9, '\1');
    CHECK_ERROR(error_of_reading(folder, "old.bmp", old), "old.bmp", "inside its header");
}

TEST_CASE("a TGA is read with or without run lengths; an error names it if it is truncated") {
    const Folder folder;
    const std::string plain = tga(2, 2, 1, 24, "\x30\x20\x10\x60\x50\x40");
    const std::vector<std::uint16_t> two{0x1010, 0x2020, 0x3030, 0x4040, 0x5050, 0x6060};
    CHECK(read_bitmap(folder.write("a.tga", plain)).values == two);
    const std::string runs = tga(10, 3, 1, 32, "\x81\x30\x20\x10\x77" + std::string("\0\x60\x50\x40\xff", 5));
    const Bitmap run = read_bitmap(folder.write("b.TGA", runs));
    CHECK(run.values[0] == 0x1010);
    CHECK(run.values[3] == 0x1010);
    CHECK(run.values[8] == 0x6060);
    CHECK(run.opacity == std::vector<std::uint16_t>{0x7777, 0x7777, 65535});
    for (const std::string& whole : {plain, runs}) {
        const std::string cut = whole.substr(0, whole.size() - 1);
        CHECK_ERROR(error_of_reading(folder, "cut.tga", cut), "cut.tga", "cut short");
    }
    CHECK_ERROR(error_of_reading(folder, "vast.tga", tga(10, 9000, 9000, 24, "\xff\1\2\3")), "cut short");
    std::string indexed = tga(1, 1, 1, 8, std::string(9, '\1'));
    indexed.replace(1, 7, std::string("\1\1\2\0\2\0\x18", 7)); // two colours of 24 bits, from index 2 on
    CHECK_ERROR(error_of_reading(folder, "from.tga", indexed), "from.tga", "colour 2");
}

TEST_CASE("a file that is not a picture is rejected with a list of the supported formats") {
    const Folder folder;
    CHECK_ERROR(error_of_reading(folder, "a.gif", "GIF89a\1\0\1\0\0\0\0;"), "PNG, JPEG, TGA, BMP or HDR");
    CHECK_ERROR(error_of_reading(folder, "a.png", std::string("\0\0\2", 3) + std::string(99, '\1')),
                "not a PNG");
}

// ---- .hdr

TEST_CASE("the exposure of an .hdr is undone when it is read") {
    const std::string pixel = "\x80\x40\x20\x81"; // 1, 1/2, 1/4
    const auto first = [&](const std::string& lines) {
        return decode_hdr("#?RADIANCE\n" + lines + "FORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n" + pixel)(0, 0);
    };
    CHECK(first("EXPOSURE=4\n") == vec3(0.25f, 0.125f, 0.0625f));
    CHECK(first("EXPOSURE= 2.0\nEXPOSURE=.5\n") == vec3(1, 0.5f, 0.25f));
    CHECK(first("COLORCORR= 2 1 .5\n") == vec3(0.5f, 0.5f, 0.5f));
    for (const char* line :
         {"EXPOSURE=\n", "EXPOSURE=0\n", "EXPOSURE=-1\n", "EXPOSURE=nan\n", "COLORCORR=1 1\n"})
        CHECK_ERROR(error_of([&] { first(line); }), "invalid line", std::string(line).substr(0, 8));
}

TEST_CASE("an .hdr used as a texture is clamped and encoded with the sRGB curve") {
    const Folder folder;
    const std::string path =
        folder.write("a.hdr", hdr("-Y 1 +X 1", std::string("\x80\x40\0\x82", 4))); // 2, 1, 0
    CHECK(read_bitmap(path).values == std::vector<std::uint16_t>{65535, 65535, 0});
}

TEST_CASE(".hdr keeps each channel within half a step of at most 1/256 of the largest one") {
    const Folder folder;
    for (const int width : {1, 7, 8, 9, 130, 300}) { // from 8 on, rows are run-length encoded
        const Image image = gradient(width, 5);
        write_image(folder / "a.hdr", image);
        const Image back = read_image(folder / "a.hdr");
        REQUIRE(back.width == width);
        REQUIRE(back.height == 5);
        for (std::size_t i = 0; i < image.pixels.size(); ++i) {
            const vec3 p = image.pixels[i], error = abs(back.pixels[i] - p);
            CHECK(std::max({error.x, error.y, error.z}) <= std::max({p.x, p.y, p.z}) / 256);
        }
    }
}

TEST_CASE(".hdr values are rounded so that writing does not make a picture darker") {
    double written = 0, read = 0;
    for (int i = 0; i < 10000; ++i) {
        const float value = std::exp(float(i) * 0.001f);
        written += double(value);
        read += double(linear_from_rgbe(rgbe_from_linear(vec3(value))).x);
    }
    CHECK(std::abs(read / written - 1) < 1e-4);
}

TEST_CASE(
    ".hdr has correct exponents at powers of two, at values that round up to one, and at the extremes") {
    for (int power = -126; power < 127; ++power) {
        const float value = std::ldexp(1.0f, power);
        CHECK(linear_from_rgbe(rgbe_from_linear(vec3(value, 0, value / 2))) == vec3(value, 0, value / 2));
    }
    CHECK(linear_from_rgbe(rgbe_from_linear(vec3(0.9999f))) == vec3(1.0f)); // 255.97 rounds to 256
    CHECK(rgbe_from_linear(vec3(0.0f)) == Rgbe{0, 0, 0, 0});
    CHECK(rgbe_from_linear(vec3(-3, 1, -0.0f)) == rgbe_from_linear(vec3(0, 1, 0)));
    const float most = std::numeric_limits<float>::max(), least = std::numeric_limits<float>::denorm_min();
    CHECK(rgbe_from_linear(vec3(most, 0, 0)) == Rgbe{255, 0, 0, 255});
    CHECK(rgbe_from_linear(vec3(least)) == Rgbe{0, 0, 0, 0});
}

TEST_CASE(".hdr keeps runs and literals of any length") {
    Image image(1000, 1);
    for (int x = 0; x < 1000; ++x)
        image(x, 0) = vec3(x < 400 ? 1.0f : x < 403 ? 2.0f : float(x % 5 + x / 600));
    const std::string bytes = encode_hdr(image);
    CHECK(bytes.size() < 4000); // 4000 bytes uncompressed
    CHECK(decode_hdr(bytes).pixels == image.pixels);
}

TEST_CASE(".hdr data that were read are written again byte for byte") {
    std::mt19937 random(7);
    Image image(300, 5);
    for (vec3& pixel : image.pixels) {
        const auto byte = [&] { return std::uint8_t(random() >> (random() % 2 == 0 ? 24 : 31)); };
        pixel = linear_from_rgbe({byte(), byte(), byte(), byte()});
    }
    const std::string once = encode_hdr(image);
    CHECK(encode_hdr(decode_hdr(once)) == once);
}

TEST_CASE(".hdr without runs, as other programs write it, is read") {
    const Folder folder;
    const std::string flat =
        folder.write("flat.hdr", hdr("-Y 1 +X 9", "\x80\x40\x20\x81" + std::string(32, '\x80')));
    const Image image = read_image(flat);
    CHECK(image(0, 0) == vec3(1.0f, 0.5f, 0.25f));
    CHECK(image(8, 0) == vec3(0.5f));
}

TEST_CASE("a truncated .hdr is reported as such and does not hang") {
    const std::string whole = encode_hdr(gradient(40, 6));
    for (std::size_t size = 0; size < whole.size(); ++size) {
        const std::string message = error_of([&] { decode_hdr(whole.substr(0, size)); });
        CHECK_MESSAGE(contains(message, "cut short"), (std::to_string(size) + " bytes: " + message));
    }
}

TEST_CASE("a damaged .hdr is an error with its path") {
    const Folder folder;
    const std::string row = "\x02\x02" + std::string(1, '\0') + "\x08";
    CHECK_ERROR(error_of_reading(folder, "a.hdr", hdr("-Y 1 +X 8", row + "\x89\x01" + std::string(99, '\1'))),
                "a.hdr", "damaged");
    CHECK_ERROR(error_of_reading(folder, "b.hdr", hdr("-Y 1 +X 8", row + std::string(99, '\0'))), "b.hdr",
                "damaged");
    CHECK_ERROR(error_of_reading(folder, "c.hdr", hdr("-Y 1 +X 9", row + std::string(99, '\1'))),
                "the wrong width");
    CHECK_ERROR(error_of_reading(folder, "d.hdr", hdr("+X 8 -Y 1", row)), "d.hdr", "-Y height +X width");
    CHECK_ERROR(error_of_reading(folder, "e.hdr", hdr("-Y 99999999999 +X 1", row)), "e.hdr", "size");
    CHECK_ERROR(error_of_reading(folder, "f.hdr", hdr("-Y 16000 +X 16000", row)), "f.hdr", "too large");
    CHECK_ERROR(error_of_reading(folder, "g.hdr", hdr("-Y 8000 +X 8000", row)), "g.hdr", "cut short");
    CHECK_ERROR(error_of_reading(folder, "h.hdr", "P6\n1 1\n255\nabc"), "h.hdr", "not a Radiance");
    CHECK_ERROR(error_of_reading(folder, "i.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\nabcd"),
                "i.hdr", "32-bit_rle_rgbe");
    CHECK_ERROR(error_of_reading(folder, "j.hdr", ""), "j.hdr", "cut short");
}

// ---- non-finite values

TEST_CASE("a pixel that is NaN or infinite is magenta in both formats") {
    const Folder folder;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    Image image = uniform(3, 1, vec3(0.5f));
    image(0, 0).y = nan;
    image(2, 0).x = infinity;
    for (const char* name : {"a.png", "a.hdr"}) {
        write_image(folder / name, image);
        const Image back = read_image(folder / name);
        CHECK(back(0, 0) == vec3(1, 0, 1));
        CHECK(back(1, 0) == approx(vec3(0.5f), 3e-3f));
        CHECK(back(2, 0) == vec3(1, 0, 1));
    }
}

// ---- unreadable files

TEST_CASE("a picture that cannot be read is an error with its path and the reason") {
    const Folder folder;
    CHECK_ERROR(error_of([&] { read_image(folder / "none.png"); }), "none.png", "no such file");
    CHECK_ERROR(error_of([&] { read_image(folder / "none.hdr"); }), "none.hdr", "no such file");
    CHECK_ERROR(error_of([&] { read_bitmap(text_of(folder.path)); }), "is a folder");
    CHECK_ERROR(error_of_reading(folder, "empty.png", ""), "empty.png", "is empty");
    CHECK_ERROR(error_of_reading(folder, "noise.png", "no picture at all"), "noise.png", "damaged");
    CHECK_ERROR(error_of_reading(folder, "gif.png", "GIF89a\1\0\1\0\0\0\0;"), "gif.png", "damaged");
    CHECK_ERROR(error_of_reading(folder, "wide.png", png(1 << 20, 1, 8, 0, "")), "wide.png", "large");
    CHECK_ERROR(error_of_reading(folder, "many.png", png(1 << 14, 1 << 14, 8, 0, "")), "many.png",
                "too large");
    CHECK_ERROR(error_of_reading(folder, "none.png", png(0, 1, 8, 0, "")), "none.png");
    const std::string odd = png(1, 1, 8, 0, std::string(2, '\0')).insert(33, chunk("A\n\x01\xff", ""));
    CHECK_ERROR(error_of_reading(folder, "odd.png", odd), "odd.png",
                "(A??? PNG chunk not known)"); // as one line
    CHECK_ERROR(error_of_reading(folder, "short.png", png(40, 40, 8, 2, "too few rows")), "short.png",
                "damaged");
}

TEST_CASE("a truncated PNG is an error and not half a picture") {
    const Folder folder;
    write_image(folder / "whole.png", gradient(40, 30));
    const std::string whole = bytes_of(folder / "whole.png");
    for (std::size_t size = 0; size + 20 < whole.size(); size += 7)
        CHECK_ERROR(error_of_reading(folder, "cut.png", whole.substr(0, size)), "cut.png");
}

#if !defined(_WIN32)
TEST_CASE("a device is rejected as a picture and not read endlessly") {
    CHECK_ERROR(error_of([] { read_image("/dev/zero"); }), "/dev/zero", "device");
}
#endif

TEST_CASE("file names with spaces and non-Latin letters are read and written") {
    const Folder folder;
    for (const char* name : {"ein Bild.png", "Füße.png", "猫.hdr", "Größe/猫 牛.PNG"}) {
        folder.write(std::string(name) + ".neighbour", ""); // creates the folder
        check_writable(folder / name);
        write_image(folder / name, uniform(9, 2, vec3(1, 0, 0.5f)));
        CHECK(read_image(folder / name)(8, 1) == approx(vec3(1, 0, 0.5f), 3e-3f));
    }
}

// ---- writing

TEST_CASE("an output that cannot be written is detected before rendering") {
    const Folder folder;
    fs::create_directories(folder.path / "folder.png");
    CHECK_ERROR(error_of([&] { check_writable(folder / "folder.png"); }), "folder.png", "is a folder");
    CHECK_ERROR(error_of([&] { check_writable(folder / "none/a.png"); }), "none/a.png", "does not exist");
    CHECK_ERROR(error_of([&] { check_writable(folder / "a.jpg"); }), "a.jpg", ".png or .hdr");
    CHECK_ERROR(error_of([&] { check_writable(folder / "a"); }), ".png or .hdr");
    CHECK_ERROR(error_of([&] { check_writable(""); }), ".png or .hdr");
    CHECK_ERROR(error_of([&] { check_writable(folder / ".png"); }), ".png or .hdr");
    const std::string file = folder.write("file.hdr", "");
    CHECK_ERROR(error_of([&] { check_writable(file + "/a.png"); }), "not a folder");
}

TEST_CASE("the test whether an output can be written leaves no trace") {
    const Folder folder;
    check_writable(folder / "new.png");
    CHECK(folder.files() == 0);
    const std::string old = folder.write("old.png", "as it was");
    check_writable(old);
    CHECK(bytes_of(old) == "as it was");
    CHECK(folder.files() == 1);
}

TEST_CASE("a picture without pixels or with too many is not written") {
    const Folder folder;
    CHECK_ERROR(error_of([&] { write_image(folder / "a.png", Image()); }), "a.png", "no pixels");
    CHECK_ERROR(error_of([&] { write_image(folder / "a.hdr", Image(1 << 15, 1)); }), "a.hdr", "too large");
    CHECK(folder.files() == 0);
    CHECK(size_error(max_dimension, int(max_pixels / max_dimension)).empty());
    CHECK(contains(size_error(max_dimension, int(max_pixels / max_dimension) + 1), "too large"));
}

TEST_CASE("writing replaces the old file and leaves nothing else behind") {
    const Folder folder;
    const std::string path = folder.write("a.png", "old");
    write_image(path, uniform(2, 2, vec3(1.0f)));
    CHECK(read_bitmap(path).width == 2);
    CHECK(folder.files() == 1);
}

#if !defined(_WIN32)
namespace {

/// A simulated disk that accepts only this many bytes, during its lifetime.
class FullDisk {
  public:
    explicit FullDisk(rlim_t bytes) : handler(std::signal(SIGXFSZ, SIG_IGN)) {
        getrlimit(RLIMIT_FSIZE, &before);
        const rlimit small{bytes, before.rlim_max};
        setrlimit(RLIMIT_FSIZE, &small);
    }
    ~FullDisk() {
        setrlimit(RLIMIT_FSIZE, &before);
        std::signal(SIGXFSZ, handler);
    }
    FullDisk(const FullDisk&) = delete;
    FullDisk& operator=(const FullDisk&) = delete;

  private:
    rlimit before{};
    void (*handler)(int);
};

} // namespace

TEST_CASE("a full disk is an error; the old file survives and no partial file remains") {
    const Folder folder;
    const std::string old = folder.write("old.hdr", "as it was");
    std::string message, message_of_new;
    {
        const FullDisk disk(50); // less than a buffer: the stream fails only when it is closed
        message = error_of([&] { write_image(old, gradient(9, 9)); });
        message_of_new = error_of([&] { write_image(folder / "new.png", gradient(400, 400)); });
    }
    CHECK_ERROR(message, "old.hdr", "File too large", "unchanged");
    CHECK_ERROR(message_of_new, "new.png", "File too large");
    CHECK(bytes_of(old) == "as it was");
    CHECK(folder.files() == 1);
}

TEST_CASE("a device or pipe is never replaced by a picture") {
    const Folder folder; // a test pipe: as the superuser, an error must not replace /dev/full
    REQUIRE(mkfifo((folder / "pipe.png").c_str(), 0600) == 0);
    CHECK_ERROR(error_of([&] { check_writable(folder / "pipe.png"); }), "pipe.png", "not a plain file");
    CHECK_ERROR(error_of([&] { write_image(folder / "pipe.png", gradient(9, 9)); }), "pipe.png",
                "not a plain file");
    CHECK_ERROR(error_of([&] { read_image(folder / "pipe.png"); }), "pipe.png", "not a plain file");
    CHECK(fs::is_fifo(folder.path / "pipe.png"));
    CHECK(folder.files() == 1);
}

TEST_CASE("a link stays a link and the file that it names is replaced") {
    const Folder folder;
    folder.write("there/a.png", "old");
    fs::create_symlink("there/a.png", folder.path / "here.png");
    write_image(folder / "here.png", gradient(9, 9));
    CHECK(fs::is_symlink(folder.path / "here.png"));
    CHECK(read_bitmap(folder / "there/a.png").width == 9);
}

TEST_CASE("a write-protected output is detected before rendering") {
    if (geteuid() == 0) {
        SKIP_CHECK("the superuser can write everywhere");
        return;
    }
    const Folder folder;
    const std::string path = folder.write("a.png", "old");
    fs::permissions(path, fs::perms::owner_read);
    CHECK_ERROR(error_of([&] { check_writable(path); }), "a.png", "write-protected");
    fs::create_directories(folder.path / "closed");
    fs::permissions(folder.path / "closed", fs::perms::owner_read | fs::perms::owner_exec);
    CHECK_ERROR(error_of([&] { check_writable(folder / "closed/a.png"); }), "closed/a.png",
                "Permission denied");
    fs::permissions(folder.path / "closed", fs::perms::owner_all);
}
#endif

TEST_CASE("discarding an unfinished file does nothing if there is none") {
    discard_unfinished_file();
    const Folder folder;
    write_image(folder / "a.png", gradient(3, 3));
    discard_unfinished_file();
    CHECK(folder.files() == 1);
}

TEST_CASE("a path is printed in full") {
    CHECK(absolute_path("renders/../a.png") == text_of(fs::current_path() / "a.png"));
}
