// What most programs and checks include and no learner changes: parsed once for all of them.
#pragma once

#include "common/big_vector.h"
#include "common/error.h"
#include "common/image_file.h"
#include "common/match.h"
#include "common/obj_file.h"
#include "common/options.h"
#include "common/parallel.h"
#include "common/paths.h"
#include "common/random.h"
#include "common/render.h"
#include "common/row.h"
#include "common/tally.h"
#include "common/vec.h"

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
