// The one place where the code of stb_image and stb_image_write is compiled: by our compiler, so that the
// sanitizers and cross builds cover it. PNG alone, and JPEG where the header at hand reads it safely. Sizes
// are checked by image_file.cpp before anything is decoded: it can say what is too large.
#define STB_IMAGE_IMPLEMENTATION
#define STBI_NO_STDIO
#define STBI_ONLY_PNG
#if defined(RT_STB_JPEG) && RT_STB_JPEG
#define STBI_ONLY_JPEG
#endif
#include <stb_image.h>

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STBI_WRITE_NO_STDIO
#include <stb_image_write.h>
