// What it was measured on.
#pragma once

#include "engine/device.h"
#include "tools/accuracy/results.h"

namespace accuracy {

Machine describeMachine(const engine::Device& device);
double processorSeconds(); // of this process so far, all its threads

} // namespace accuracy
