// What the pattern that is asked of a body says of how its sites lie.
#include "shared/breaking.h"
#include "shared/material.h"

uint spreadOf(uint pattern) { return pattern == PATTERN_UNIFORM ? SPREAD_EVEN : pattern == PATTERN_PAPER ? SPREAD_PAPER : SPREAD_ABOUT_BLOW; }
