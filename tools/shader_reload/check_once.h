// shader_reload --once: every kernel of a folder, compiled and checked, without a device.
#pragma once

#include "engine/result.h"
#include "tools/shader_reload/options.h"

namespace shader_reload {

// Mistakes go to stderr, as editors read them, what came of it to stdout; whether all kernels are sound. Errors: BadInput, for
// a folder without kernels.
engine::Result<bool> checkOnce(const Options& options);

} // namespace shader_reload
