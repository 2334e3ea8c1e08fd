// Precompiled header: what most checks include and no learner changes.
#pragma once

#include "tests/check.h"

#include "common/pch.h"
