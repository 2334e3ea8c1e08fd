// What kind of picture a file holds, and what must be looked at before stb_image decodes it.
#pragma once

#include <string>
#include <string_view>

namespace rt {

enum class ImageKind { png, jpeg, tga, bmp, hdr, unknown };

/// By the first bytes, whatever the name says; a .tga file is known by its name alone.
ImageKind image_kind_of(const std::string& path, std::string_view bytes);

/// What stb_image 2.27 to 2.30 reads from a PNG without fault: palettes filled up to 256 colours (with
/// black: a pixel may name one that is not there, and stb would show what lay in memory), no chunk of data
/// without a byte. Throws Error if it is cut short, or states a size that its data cannot fill.
std::string mended_png(std::string_view bytes);

/// The same of a BMP. Throws Error also if its pixels begin inside its header: stb would read no palette.
std::string mended_bmp(std::string_view bytes, int width, int height);

/// Throws Error if a TGA of this size is cut short, or if its palette does not begin with colour 0.
void check_tga(std::string_view bytes, int width, int height);

/// True if a JPEG is cut short: no end is marked behind its last scan.
bool is_cut_jpeg(std::string_view bytes);

} // namespace rt
