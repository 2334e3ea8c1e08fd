// What most checks include and no learner changes: parsed once for all of them.
#pragma once

#include "tests/check.h"

#include "common/pch.h"
