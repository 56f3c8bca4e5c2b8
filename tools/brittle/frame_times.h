// When pictures of a motion are taken.
#pragma once

#include "engine/result.h"

#include <vector>

namespace cli {

// Every 1 / fps seconds from 0 on, up to `seconds`. Errors: BadInput, for more than a million.
engine::Result<std::vector<double>> frameTimes(double seconds, double fps);
// The same and the last moment, where no frame falls on it.
engine::Result<std::vector<double>> frameTimesAndEnd(double seconds, double fps);

} // namespace cli
