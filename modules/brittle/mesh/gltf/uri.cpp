#include "modules/brittle/mesh/gltf/uri.h"

#include "modules/brittle/mesh/gltf/element.h"

#include <array>

namespace brittle::gltf {
namespace {

constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
constexpr uint8_t kNoDigit = 64;

int hexDigit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

std::array<uint8_t, 256> makeValues() {
    std::array<uint8_t, 256> values;
    values.fill(kNoDigit);
    for (size_t k = 0; k < kDigits.size(); ++k)
        values[static_cast<uint8_t>(kDigits[k])] = static_cast<uint8_t>(k);
    return values;
}

std::string decodeBase64(std::string_view text, const std::string& where) {
    static const std::array<uint8_t, 256> kValues = makeValues();
    while (text.ends_with('='))
        text.remove_suffix(1);
    std::string bytes;
    bytes.reserve(text.size() / 4 * 3 + 2);
    uint32_t group = 0;
    for (size_t k = 0; k < text.size(); ++k) {
        const uint8_t value = kValues[static_cast<uint8_t>(text[k])];
        if (value == kNoDigit) refuse(where, "character " + std::to_string(k) + " of its data is not base64");
        group = group << 6 | value;
        if (k % 4 > 0) bytes += static_cast<char>(group >> (6 - 2 * (k % 4)) & 255);
    }
    if (text.size() % 4 == 1) refuse(where, "its base64 data is cut short");
    return bytes;
}

} // namespace

bool isAbsolute(std::string_view uri) {
    if (uri.starts_with('/') || uri.starts_with('\\')) return true;
    const size_t colon = uri.find(':');
    return colon != uri.npos && uri.find('/') > colon;
}

std::string decodePercent(std::string_view uri) {
    std::string text;
    for (size_t k = 0; k < uri.size(); ++k) {
        const int high = uri[k] == '%' && k + 2 < uri.size() ? hexDigit(uri[k + 1]) : -1;
        const int low = high >= 0 ? hexDigit(uri[k + 2]) : -1;
        text += low >= 0 ? static_cast<char>(16 * high + low) : uri[k];
        if (low >= 0) k += 2;
    }
    return text;
}

std::string withEscapes(std::string_view text) {
    constexpr std::string_view kHex = "0123456789ABCDEF";
    std::string escaped;
    for (const char c : text) {
        const auto code = static_cast<uint8_t>(c);
        const bool is_control = code < 0x20 || code == 0x7F;
        if (is_control)
            escaped += {'%', kHex[code / 16], kHex[code % 16]};
        else
            escaped += c;
    }
    return escaped;
}

std::string decodeDataUri(std::string_view uri, const std::string& where) {
    const size_t comma = uri.find(',');
    if (comma == uri.npos) refuse(where, "its data: URI has no comma");
    const std::string_view head = uri.substr(0, comma), data = uri.substr(comma + 1);
    if (!head.ends_with(";base64")) return decodePercent(data);
    return data.find('%') == data.npos ? decodeBase64(data, where) : decodeBase64(decodePercent(data), where);
}

} // namespace brittle::gltf
