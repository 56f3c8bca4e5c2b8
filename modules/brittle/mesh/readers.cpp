#include "modules/brittle/mesh/readers.h"

#include <algorithm>

namespace brittle {

engine::Error badInput(std::string message) { return {engine::ErrorCode::BadInput, std::move(message)}; }

engine::Error badLine(size_t line, const std::string& message) {
    return badInput("line " + std::to_string(line) + ": " + message);
}

bool looksBinary(std::string_view bytes) { return bytes.find('\0') != bytes.npos; }

// By its byte order mark, or by zeros in every second of the first bytes.
bool isUtf16(std::string_view bytes) {
    if (bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF")) return true;
    constexpr size_t kBytes = 16;
    if (bytes.size() < kBytes) return false;
    size_t zeros[2] = {0, 0};
    for (size_t k = 0; k < kBytes; ++k)
        zeros[k % 2] += bytes[k] == '\0' ? 1 : 0;
    return (zeros[0] == kBytes / 2 && zeros[1] == 0) || (zeros[1] == kBytes / 2 && zeros[0] == 0);
}

std::string_view withoutPadding(std::string_view bytes) {
    while (!bytes.empty() && (bytes.back() == '\0' || bytes.back() == '\x1A'))
        bytes.remove_suffix(1);
    return bytes;
}

engine::Result<void> checkIsText(std::string_view bytes, const char* format) {
    if (isUtf16(bytes)) return badInput(kUtf16);
    const size_t zero = bytes.find('\0');
    if (zero == bytes.npos) return {};
    return badLine(static_cast<size_t>(std::ranges::count(bytes.substr(0, zero), '\n')) + 1,
                   std::string("binary data where ") + format +
                       " text was expected; give the file the ending of its real format");
}

std::string oneLine(std::string text) {
    std::replace_if(
        text.begin(), text.end(), [](char c) { return c >= 0 && c < ' '; }, ' ');
    if (text.size() > 200) text = text.substr(0, 200) + "...";
    return text;
}

std::string LeftOut::described(const std::string& noun) const {
    const std::string line = "line " + std::to_string(first_line_);
    if (count_ == 1) return "1 " + noun + " (in " + line + ")";
    return std::to_string(count_) + " " + noun + "s (first in " + line + ")";
}

} // namespace brittle
