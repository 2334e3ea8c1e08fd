// What the world is made of: shapes, materials by index, lights, and a sky around it all.
#pragma once

#include "01_spheres/checkerboard.h"
#include "01_spheres/diffuse.h"
#include "01_spheres/sky.h"
#include "02_shadows/point_light.h"
#include "03_mirror/mirror.h"
#include "03_mirror/shapes.h"
#include "common/util/add.h"

#include <variant>
#include <vector>

namespace rt {

using Material = std::variant<Diffuse, Checkerboard, Mirror, Coated>;

struct Scene : Shapes {
    Sky sky;
    std::vector<PointLight> lights;
    std::vector<Material> materials;
};

} // namespace rt
