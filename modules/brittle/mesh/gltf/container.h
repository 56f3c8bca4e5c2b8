// Splits a GLB file into its chunks; a glTF file is its JSON alone.
#pragma once

#include <string_view>

namespace brittle::gltf {

struct Container {
    std::string_view json;
    std::string_view binary; // of the BIN chunk
    bool has_binary = false;
};

// Views into `bytes`. The first four bytes tell GLB from text, not the name of the file.
Container splitContainer(std::string_view bytes);

} // namespace brittle::gltf
