#include "tools/device_check/cached_start.h"

namespace device_check {

ChildEnd runWithCache(ChildCommand command, const std::filesystem::path& cache) {
    for (const char* name : {"MESA_SHADER_CACHE_DIR", "__GL_SHADER_DISK_CACHE_PATH", "XDG_CACHE_HOME", "HOME"})
        command.environment.push_back(std::string(name) + "=" + cache.string());
    command.environment.emplace_back("__GL_SHADER_DISK_CACHE=1"); // NVIDIA's driver keeps none for root otherwise
    return runChild(command, [](std::string_view) {});
}

} // namespace device_check
