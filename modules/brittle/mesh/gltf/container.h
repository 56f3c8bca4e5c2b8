// Splits a GLB file into its chunks; a glTF file is its JSON alone.
#pragma once

#include <string_view>

namespace brittle::gltf {

struct Container {
    std::string_view json;
    std::string_view binary; // of the BIN chunk
    bool has_binary = false;
    size_t bytes_behind = 0; // the last chunk: no part of the file by its header
};

// Views into `bytes`. The first four bytes tell GLB from text, not the name of the file. UTF-16 is refused.
Container splitContainer(std::string_view bytes);

} // namespace brittle::gltf
