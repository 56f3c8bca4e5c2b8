// The compiled kernels, as they lie in the library.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace shaders {

struct Module {
    std::string_view name;
    std::span<const uint32_t> words;
};

// Every row of kernels.cmake, in its order.
std::span<const Module> all();

// nullptr if there is none of this name.
const Module* find(std::string_view name);

} // namespace shaders
