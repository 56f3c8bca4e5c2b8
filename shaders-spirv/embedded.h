// The compiled kernels, as they lie in the library.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace shaders {

struct Module {
    std::string_view name;
    std::span<const uint32_t> words;
    // Its row in the table, from which it can be made anew: the source, relative to the table, and "NAME=VALUE", with spaces
    // between them.
    std::string_view file, defines;
};

// Every row of kernels.cmake, in its order.
std::span<const Module> all();

// nullptr if there is none of this name.
const Module* find(std::string_view name);

} // namespace shaders
