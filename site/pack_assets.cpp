// Writes the models and textures of the steps as plain bytes, which the programs of the web edition read.
// pack_assets FOLDER FILE...: writes FOLDER/NAME for each FILE, a path that ends in NAME.
#include "common/image/image_file.h"
#include "common/model/obj_file.h"
#include "common/util/file_bytes.h"
#include "common/util/paths.h"
#include "common/util/report_error.h"
#include "site/twins/packed.h"

#include <exception>
#include <filesystem>
#include <string>

namespace rt {
namespace {

std::string packed(const std::filesystem::path& path) {
    Packer packer;
    if (path.extension() == ".obj") {
        ObjModel model = read_obj(text_of(path));
        pack_model(packer, model);
    } else {
        Bitmap bitmap = read_bitmap(text_of(path));
        pack_bitmap(packer, bitmap);
    }
    return packer.bytes;
}

} // namespace
} // namespace rt

int main(int argc, char** argv) {
    try {
        for (int i = 2; i < argc; ++i) {
            const std::filesystem::path path = rt::path_of(argv[i]);
            rt::write_file(rt::text_of(rt::path_of(argv[1]) / path.filename()), rt::packed(path));
        }
        return 0;
    } catch (const std::exception& problem) {
        return rt::report_error("pack_assets", problem.what());
    }
}
