// The line that says which GLSL a source is written in.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace engine {

// Why a source cannot be GLSL for Vulkan before a line of it is compiled: without a version, or of one that the compiler cannot
// even begin with, it prints pages instead of a message. A file that is being written often is such a source.
std::optional<std::string> versionTrouble(std::string_view text);

} // namespace engine
