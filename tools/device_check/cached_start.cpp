#include "tools/device_check/cached_start.h"

namespace device_check {

std::vector<std::string> cacheSettings(const std::filesystem::path& cache) {
    const std::string folder = cache.string();
    return {"MESA_SHADER_CACHE_DISABLE=false", "MESA_SHADER_CACHE_DIR=" + folder, "__GL_SHADER_DISK_CACHE=1",
            "__GL_SHADER_DISK_CACHE_PATH=" + folder, "XDG_CACHE_HOME=" + folder};
}

ChildEnd runWithCache(ChildCommand command, const std::filesystem::path& cache) {
    for (std::string& setting : cacheSettings(cache))
        command.environment.push_back(std::move(setting));
    command.environment.push_back("HOME=" + cache.string());
    return runChild(command, [](std::string_view) {});
}

} // namespace device_check
