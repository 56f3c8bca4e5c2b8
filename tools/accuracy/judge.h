// What the measurements say next to each other.
#pragma once

#include "tools/accuracy/results.h"

namespace accuracy {

// How settings compare within each workload: ratios, which are dominated, and the lines that are worth telling.
void judge(Results& results);

} // namespace accuracy
