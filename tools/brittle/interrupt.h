// Leaves nothing half written where a run is interrupted.
#pragma once

#include "modules/brittle/export/output_file.h"

namespace cli {

// From here on SIGINT, SIGTERM and SIGHUP remove what createOutput has begun and was not committed, and end the process as they
// would have. To be called before any other thread is started.
void cleanUpWhenInterrupted();

// OutputFile::create, for a file that an interrupt removes.
engine::Result<brittle::OutputFile> createOutput(const std::filesystem::path& path);

} // namespace cli
