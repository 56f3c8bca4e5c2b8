#include "shaders-spirv/embedded.h"

#include <algorithm>

namespace shaders {

const Module* find(std::string_view name) {
    const auto found = std::ranges::find(all(), name, &Module::name);
    return found == all().end() ? nullptr : &*found;
}

} // namespace shaders
