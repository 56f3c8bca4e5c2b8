// shader_reload: a scene that is stepped on and on while its kernels are edited.
#pragma once

#include "engine/result.h"
#include "tools/shader_reload/options.h"

namespace shader_reload {

// Until it is interrupted, its window is closed, or it has made as many steps as it was asked for. What happens goes to stdout,
// mistakes in sources to stderr. Errors: those of scenes, worlds and devices.
engine::Result<void> runLive(const Options& options);

} // namespace shader_reload
