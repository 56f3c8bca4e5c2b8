#include "engine/unchecked_kernels.h"

#include "engine/device.h"
#include "engine/instance.h"

#include <algorithm>
#include <cstdlib>

namespace engine {
namespace {

std::string_view namedKernels() {
    const char* list = std::getenv("BRITTLE_UNCHECKED_KERNELS");
    return list == nullptr || !gpuAssistedValidationIsOn() ? "" : list;
}

} // namespace

std::vector<std::string> extensionsForUncheckedKernels() {
    if (namedKernels().empty()) return {};
    return {VK_KHR_PIPELINE_LIBRARY_EXTENSION_NAME, VK_EXT_GRAPHICS_PIPELINE_LIBRARY_EXTENSION_NAME};
}

bool leavesUnchecked(const Device& device, std::string_view kernel) {
    const bool can_be = std::ranges::count(device.extensions(), VK_EXT_GRAPHICS_PIPELINE_LIBRARY_EXTENSION_NAME) != 0;
    return can_be && isNamedIn(namedKernels(), kernel);
}

bool isNamedIn(std::string_view list, std::string_view kernel) {
    while (!list.empty()) {
        const std::string_view name = list.substr(0, list.find(','));
        if (name == kernel) return true;
        list.remove_prefix(std::min(list.size(), name.size() + 1));
    }
    return false;
}

} // namespace engine
