// Facts about names of files in any alphabet: folder, model, materials and texture.
#include "common/model/obj_file.h"
#include "tests/malformed/folder.h"

#include <doctest/doctest.h>

using namespace rt;
using namespace rt::malformed;

TEST_CASE("the names of a model's folder and files and texture may be in any alphabet") {
    const Folder folder;
    for (const std::string name : {"σφαίρα", "шар", "球体", "🐮 🥛", "Füße"}) {
        CAPTURE(name);
        const std::string mtl = "newmtl m\nmap_Kd " + name + ".png\n";
        folder.write(name + "/" + name + ".mtl", mtl);
        const std::string obj =
            folder.write(name + "/" + name + ".obj",
                         "mtllib " + name + ".mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
        write_image(folder / (name + "/" + name + ".png"), Image(3, 2));
        const Stderr errors;
        const ObjModel model = read_obj(obj);
        REQUIRE(model.textures.size() == 1);
        CHECK(model.textures[0].width == 3);
        CHECK(errors.text().empty());
    }
}
