// Detects the format of an image file, and checks or repairs it before stb_image decodes it.
#pragma once

#include <string>
#include <string_view>

namespace rt {

enum class ImageKind { png, jpeg, tga, bmp, hdr, unknown };

/// Returns the format by the file's first bytes, whatever its name; only .tga is recognised by its name.
ImageKind image_kind_of(const std::string& path, std::string_view bytes);

/// Returns a PNG that stb_image 2.27 to 2.30 reads without a fault: palettes are filled up to 256
/// colours with black (a pixel may use an index beyond the palette, for which stb would show
/// uninitialised memory), and empty data chunks are removed. Throws Error if the PNG is truncated or
/// states a size that its data cannot fill.
std::string mended_png(std::string_view bytes);

/// Returns a BMP that stb_image reads without a fault, as mended_png() does. Throws Error also if its pixels
/// begin inside its header, since stb would read no palette then.
std::string mended_bmp(std::string_view bytes, int width, int height);

/// Throws Error if a TGA of this size is truncated, or if its palette does not begin with colour 0.
void check_tga(std::string_view bytes, int width, int height);

/// Returns whether a JPEG is truncated: it has no end marker after its last scan.
bool is_cut_jpeg(std::string_view bytes);

} // namespace rt
