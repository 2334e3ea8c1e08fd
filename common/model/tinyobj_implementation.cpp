// Compiles tinyobjloader once, with our flags, so that sanitizers and cross builds cover it.
#define TINYOBJLOADER_IMPLEMENTATION
#include <tiny_obj_loader.h>
