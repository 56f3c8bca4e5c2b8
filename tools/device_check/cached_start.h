// Starts programs with a cache of compiled kernels of their own, to see what a cold and a warm start take.
#pragma once

#include "tools/device_check/child_process.h"

#include <filesystem>

namespace device_check {

// Settings by which Mesa's, NVIDIA's and AMD's drivers keep compiled kernels in `cache`, a folder that exists. Mesa 22.3 keeps
// none if the folder is missing; NVIDIA's driver keeps none for root without its variable.
std::vector<std::string> cacheSettings(const std::filesystem::path& cache);

// Runs a program as runChild does. The driver keeps its cache in `cache` alone, a folder that exists: Mesa's and NVIDIA's drivers do.
ChildEnd runWithCache(ChildCommand command, const std::filesystem::path& cache);

} // namespace device_check
