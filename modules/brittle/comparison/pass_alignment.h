// Which pass of one device's step is which pass of another's. Devices may take different kernels for the same task: those
// passes have no partner.
#pragma once

#include "modules/brittle/comparison/step_capture.h"

#include <span>
#include <string>
#include <utility>
#include <vector>

namespace brittle {

// The same for passes that do the same: stage, kernel and buffers. Versions of a kernel for wide subgroups ("_wide") count as
// the kernel itself.
std::string keyOf(const Pass& pass);

// Indices into `a` and `b` of passes with the same key: a longest common subsequence, in order.
std::vector<std::pair<uint32_t, uint32_t>> alignKeys(std::span<const std::string> a, std::span<const std::string> b);
std::vector<std::pair<uint32_t, uint32_t>> alignPasses(const StepCapture& a, const StepCapture& b);

} // namespace brittle
