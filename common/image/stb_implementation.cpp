// Compiles stb_image and stb_image_write once, with our flags, so that sanitizers and cross builds cover it.
// bitmap_file.cpp checks a file before stb_image decodes it, so that a message can say whether it is
// too large or truncated.
#include "common/image/stb_memory.h"

#include <cstdlib>

namespace {

bool may_have(std::size_t size) {
    if (size <= rt::stb_memory.largest_block) return true;
    rt::stb_memory.was_refused = true;
    return false;
}

void* stb_allocate(std::size_t size) {
    return may_have(size) ? std::calloc(size, 1) : nullptr;
}

void* stb_reallocate(void* block, std::size_t size) {
    return may_have(size) ? std::realloc(block, size) : nullptr;
}

} // namespace

#define STBI_MALLOC(size) stb_allocate(size)
#define STBI_REALLOC(block, size) stb_reallocate(block, size)
#define STBI_FREE(block) std::free(block)

#define STB_IMAGE_IMPLEMENTATION
#define STBI_NO_STDIO
#define STBI_ONLY_PNG
#define STBI_ONLY_BMP
#define STBI_ONLY_TGA
#if defined(RT_STB_JPEG) && RT_STB_JPEG
#define STBI_ONLY_JPEG
#endif
#include <stb_image.h>

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STBI_WRITE_NO_STDIO
#include <stb_image_write.h>
