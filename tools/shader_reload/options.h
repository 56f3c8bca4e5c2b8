// What shader_reload was asked for.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace shader_reload {

struct Options {
    std::filesystem::path folder;
    std::vector<std::filesystem::path> include_folders; // empty: the folder
    std::string scene = "stack_10", device;
    std::optional<uint32_t> steps; // none: on and on, from the beginning again where the scene ends
    bool once = false;
    bool window = false;
};

} // namespace shader_reload
