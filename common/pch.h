// Precompiled header of the programs: what most of them include and no learner changes.
#pragma once

#include "common/util/huge_page_vector.h"
#include "common/util/error.h"
#include "common/image/image_file.h"
#include "common/util/match.h"
#include "common/model/obj_file.h"
#include "common/cli/options.h"
#include "common/util/parallel.h"
#include "common/util/paths.h"
#include "common/math/random.h"
#include "common/render/render.h"
#include "common/util/ray_stats.h"
#include "common/math/vec.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <list>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>
