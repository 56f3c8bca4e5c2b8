#include "engine/reload/version_line.h"

#include <algorithm>
#include <cctype>

namespace engine {
namespace {

constexpr std::string_view kVersions[] = {"450", "460", "310 es", "320 es"}; // that have compute shaders and Vulkan

// Past white space and comments.
std::string_view firstCode(std::string_view text) {
    for (;;) {
        const auto code = std::ranges::find_if(text, [](unsigned char c) { return std::isspace(c) == 0; });
        text.remove_prefix(static_cast<size_t>(code - text.begin()));
        const bool is_line = text.starts_with("//"), is_block = text.starts_with("/*");
        if (!is_line && !is_block) return text;
        const size_t end = is_line ? text.find('\n') : text.find("*/", 2);
        text.remove_prefix(std::min(end == std::string_view::npos ? text.size() : end + (is_line ? 1 : 2), text.size()));
    }
}

// Words of a line, with one space between them, without a comment behind them.
std::string tidied(std::string_view line) {
    std::string words;
    for (const char c : line.substr(0, std::min(line.find("//"), line.find("/*")))) {
        const bool is_space = std::isspace(static_cast<unsigned char>(c)) != 0;
        if (!is_space || (!words.empty() && words.back() != ' ')) words += is_space ? ' ' : c;
    }
    if (words.ends_with(' ')) words.pop_back();
    return words;
}

} // namespace

std::optional<std::string> versionTrouble(std::string_view text) {
    constexpr std::string_view kDirective = "version";
    std::string_view code = firstCode(text);
    if (code.empty()) return "is empty";
    std::string line = tidied(code.substr(0, code.find('\n')));
    if (line.starts_with("# ")) line.erase(1, 1);
    if (!line.starts_with("#" + std::string(kDirective)))
        return "does not begin with a version; its first line of code has to be \"#version 450\"";
    std::string version = tidied(std::string_view(line).substr(1 + kDirective.size()));
    if (version.ends_with(" core")) version.resize(version.size() - 5);
    if (std::ranges::find(kVersions, version) != std::end(kVersions)) return std::nullopt;
    return "is of version \"" + version + "\"; kernels for Vulkan are of 450 or 460 (310 es or 320 es)";
}

} // namespace engine
