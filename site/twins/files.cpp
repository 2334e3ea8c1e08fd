// Stands for the readers of models and textures: the page hands over what site/pack_assets.cpp has read on another machine.
#include "common/image/image_file.h"
#include "common/model/obj_file.h"
#include "common/model/sphere_list.h"
#include "common/util/error.h"
#include "common/util/paths.h"
#include "site/twins/page.h"
#include "site/twins/packed.h"

namespace rt {

std::string asset_path(const std::string& name) {
    return name;
}

ObjModel read_obj(const std::string& path, const ObjReadOptions&) {
    Unpacker bytes{page::file(path)};
    ObjModel model;
    pack_model(bytes, model);
    return model;
}

Bitmap read_bitmap(const std::string& path, std::int64_t) {
    Unpacker bytes{page::file(path)};
    Bitmap bitmap;
    pack_bitmap(bytes, bitmap);
    return bitmap;
}

std::vector<SphereRecord> read_sphere_list(const std::string& path) {
    throw Error(path + ": a list of spheres can only be shown in the terminal");
}

} // namespace rt
