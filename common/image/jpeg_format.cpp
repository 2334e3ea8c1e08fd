// Decodes JPEG through libjpeg.
// libjpeg reports errors through a function that must not return. Ours jumps back to the call with longjmp,
// which is valid because it skips only C frames and no object with a destructor.
#include "common/image/jpeg_format.h"

#include "common/util/error.h"

#if defined(RT_LIBJPEG) && RT_LIBJPEG

#include <cstdio> // jpeglib.h needs it

#include <jpeglib.h>

#include <array>
#include <csetjmp>
#include <vector>

namespace rt {
namespace {

constexpr int most_scans = 100; // progressive files have about ten scans; each is a pass over the whole image

struct Decoder {
    jpeg_decompress_struct info{};
    jpeg_error_mgr errors{};
    jpeg_progress_mgr progress{};
    std::jmp_buf back{};
    std::array<char, JMSG_LENGTH_MAX> reason{};

    Decoder() = default;
    Decoder(const Decoder&) = delete;
    Decoder& operator=(const Decoder&) = delete;
    ~Decoder() { jpeg_destroy_decompress(&info); }
};

Decoder& decoder_of(j_common_ptr info) {
    return *static_cast<Decoder*>(info->client_data);
}

[[noreturn]] void fail(j_common_ptr info) {
    Decoder& decoder = decoder_of(info);
    info->err->format_message(info, decoder.reason.data());
    std::longjmp(decoder.back, 1);
}

void watch_scans(j_common_ptr info) {
    Decoder& decoder = decoder_of(info);
    if (decoder.info.input_scan_number <= most_scans) return;
    std::snprintf(decoder.reason.data(), decoder.reason.size(), "it has too many scans");
    std::longjmp(decoder.back, 1);
}

/// Reads the header. Returns false on failure; `reason` then says why.
bool read_header(Decoder& decoder, const unsigned char* bytes, unsigned long size) {
    jpeg_decompress_struct& info = decoder.info;
    info.err = jpeg_std_error(&decoder.errors);
    decoder.errors.error_exit = fail;
    decoder.errors.output_message = [](j_common_ptr) {};
    decoder.progress.progress_monitor = watch_scans;
    info.client_data = &decoder;
    if (setjmp(decoder.back) != 0) return false;
    jpeg_create_decompress(&info); // keeps err and client_data
    info.progress = &decoder.progress;
    jpeg_mem_src(&info, bytes, size);
    jpeg_read_header(&info, TRUE);
    if (info.num_components == 3) info.out_color_space = JCS_RGB;
    return true;
}

bool read_rows(Decoder& decoder, unsigned char* rows) {
    jpeg_decompress_struct& info = decoder.info;
    if (setjmp(decoder.back) != 0) return false;
    jpeg_start_decompress(&info);
    while (info.output_scanline < info.output_height) {
        unsigned char* row = rows + std::size_t(info.output_scanline) * info.output_width *
                                        std::size_t(info.output_components);
        jpeg_read_scanlines(&info, &row, 1);
    }
    return true;
}

/// Returns a value of red, green or blue. Adobe's programs store inverted ink values.
std::uint16_t without_ink(int ink, int black, bool adobe) {
    const int light = adobe ? ink * black : (255 - ink) * (255 - black);
    return std::uint16_t((light * 257 + 127) / 255);
}

Bitmap unpacked(const Decoder& decoder, const std::vector<unsigned char>& rows) {
    const std::size_t channels = std::size_t(decoder.info.output_components);
    Bitmap bitmap{int(decoder.info.output_width), int(decoder.info.output_height), {}, {}, ""};
    bitmap.values.reserve(rows.size() / channels * 3);
    for (std::size_t i = 0; i < rows.size(); i += channels) {
        for (std::size_t c = 0; c < 3; ++c) {
            const int value = rows[i + (channels == 1 ? 0 : c)];
            bitmap.values.push_back(channels == 4
                                        ? without_ink(value, rows[i + 3], decoder.info.saw_Adobe_marker != 0)
                                        : std::uint16_t(value * 257));
        }
    }
    return bitmap;
}

Error undecodable(const Decoder& decoder) {
    return Error("is a damaged JPEG, or one of an unusual kind (" + std::string(decoder.reason.data()) +
                 "); save it as PNG again");
}

} // namespace

Bitmap decode_with_libjpeg(std::string_view bytes, std::int64_t pixels_left) {
    Decoder decoder;
    const auto* const data = reinterpret_cast<const unsigned char*>(bytes.data());
    if (!read_header(decoder, data, static_cast<unsigned long>(bytes.size()))) throw undecodable(decoder);
    const std::size_t width = decoder.info.image_width, height = decoder.info.image_height;
    if (const std::string why = size_error(int(width), int(height), pixels_left); !why.empty())
        throw Error(why);
    const int components = decoder.info.num_components;
    if (components != 1 && components != 3 && components != 4) throw undecodable(decoder);
    std::vector<unsigned char> rows(width * height * std::size_t(components));
    if (!read_rows(decoder, rows.data())) throw undecodable(decoder);
    Bitmap bitmap = unpacked(decoder, rows);
    if (decoder.errors.num_warnings > 0) bitmap.flaw = "is damaged";
    return bitmap;
}

} // namespace rt

#else

namespace rt {

Bitmap decode_with_libjpeg(std::string_view, std::int64_t) {
    throw Error("is a JPEG, which this build cannot read: stb_image is older than 2.28, and libjpeg was not "
                "found (on Debian: apt-get install libjpeg62-turbo-dev, remove build/, build again)");
}

} // namespace rt

#endif
