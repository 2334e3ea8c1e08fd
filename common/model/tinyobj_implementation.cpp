// The one place where the code of tinyobjloader is compiled, so that the sanitizers and cross builds cover
// it.
#define TINYOBJLOADER_IMPLEMENTATION
#include <tiny_obj_loader.h>
