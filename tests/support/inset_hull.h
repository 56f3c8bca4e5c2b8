// Hulls that are drawn in, for engines that lay a margin around them.
#pragma once

#include "tests/reference/convex.h"

#include <vector>

namespace support {

// The corners of what lies in the solid, below each of its faces by at least `depth`. None where nothing does.
std::vector<reference::Point> insetCorners(const reference::Convex& solid, double depth);

} // namespace support
