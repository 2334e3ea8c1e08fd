// What most checks include and no learner changes: parsed once for all of them.
#pragma once

#include "tests/check.h"

#include "common/error.h"
#include "common/image_file.h"
#include "common/match.h"
#include "common/obj_file.h"
#include "common/options.h"
#include "common/parallel.h"
#include "common/random.h"
#include "common/render.h"
#include "common/row.h"
#include "common/tally.h"

#include <algorithm>
#include <array>
#include <functional>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>
