// References of a glTF file to its buffers (RFC 3986 and RFC 2397).
#pragma once

#include <string>
#include <string_view>

namespace brittle::gltf {

inline bool isDataUri(std::string_view uri) { return uri.starts_with("data:"); }

// True for http:, file: and the like, and for paths from the root; such a reference is not relative to the file.
bool isAbsolute(std::string_view uri);

// Replaces %20 and the like by their bytes. A % without two hexadecimal digits stays.
std::string decodePercent(std::string_view uri);

// The text with control characters as %00 and the like, for errors.
std::string withEscapes(std::string_view text);

// The bytes within a data: URI; `where` is for errors.
std::string decodeDataUri(std::string_view uri, const std::string& where);

} // namespace brittle::gltf
