// Fuzz target for an MTL file of a small OBJ file: all numbers of its materials are in range.
#include "common/model/obj_file.h"
#include "tests/fuzz/fuzz.h"

#include <cmath>

namespace rt::fuzz {

namespace {

std::string write_model() {
    Image image(2, 2);
    image.pixels[0] = vec3(1, 0.5f, 0);
    write_image(folder() + "/t.png", image);
    return write_input("of_mtl.obj", "mtllib of_obj.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n"
                                     "usemtl b c\nf 1 2 3\nusemtl c\nf 1 3 2\n");
}

void check_material(const ObjMaterial& material, const ObjModel& file) {
    require(material.texture >= -1 && material.texture < int(file.textures.size()), "textures are in range");
    require(material.mask >= -1 && material.mask < int(file.masks.size()), "masks are in range");
    for (int i = 0; i < 3; ++i) {
        require(material.diffuse[i] >= 0 && material.diffuse[i] <= 1, "Kd is in [0, 1]");
        require(material.emission[i] >= 0 && std::isfinite(material.emission[i]), "Ke is finite");
    }
    require(material.reflectivity >= 0 && material.reflectivity <= 1, "the reflectivity is in [0, 1]");
    require(material.ior >= 1 && material.ior <= 4, "Ni is in [1, 4]");
}

} // namespace

void run_mtl(std::string_view bytes) {
    static const std::string model = write_model();
    write_input("of_obj.mtl", bytes);
    ObjModel file;
    refusal([&] { file = read_obj(model, {1, std::size_t(1) << 20}); });
    for (const ObjMaterial& material : file.materials) check_material(material, file);
}

} // namespace rt::fuzz
