// Precompiled header: what most checks include and no learner changes.
#pragma once

#include "tests/check.h"

#include "common/pch.h"

#ifdef __OPTIMIZE__ // steps whose scenes have wide trees: their vector instructions take long to parse
#include "accel/accel.h"
#endif
