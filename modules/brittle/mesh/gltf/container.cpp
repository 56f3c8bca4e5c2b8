#include "modules/brittle/mesh/gltf/container.h"

#include "modules/brittle/mesh/gltf/element.h"
#include "modules/brittle/mesh/readers.h"
#include "modules/brittle/mesh/text_reader.h"

#include <cstring>

namespace brittle::gltf {
namespace {

constexpr size_t kHeaderBytes = 12, kChunkHeaderBytes = 8;
constexpr uint32_t kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;
constexpr const char* kHeader = "the GLB header";
constexpr const char* kCopyAgain = "copy or export the file again";

uint32_t wordAt(std::string_view bytes, size_t at) {
    std::array<unsigned char, 4> b;
    std::memcpy(b.data(), bytes.data() + at, b.size());
    return b[0] | uint32_t{b[1]} << 8 | uint32_t{b[2]} << 16 | uint32_t{b[3]} << 24;
}

std::string_view withoutHeader(std::string_view bytes) {
    if (bytes.size() < kHeaderBytes) refuse(kHeader, "is cut short", kCopyAgain);
    const uint32_t version = wordAt(bytes, 4), length = wordAt(bytes, 8);
    if (version != 2) refuse(kHeader, "version is " + std::to_string(version) + ", must be 2", "convert the file to glTF 2.0");
    if (length > bytes.size())
        refuse(kHeader, "promises " + std::to_string(length) + " bytes, the file has " + std::to_string(bytes.size()),
               kCopyAgain);
    if (length < kHeaderBytes) refuse(kHeader, "length is " + std::to_string(length) + ", must be 12 or more");
    return bytes.substr(kHeaderBytes, length - kHeaderBytes);
}

// The specification pads with spaces; some programs pad with zeros.
std::string_view withoutPadding(std::string_view text) {
    while (text.ends_with('\0'))
        text.remove_suffix(1);
    return text;
}

} // namespace

Container splitContainer(std::string_view bytes) {
    if (isUtf16(bytes)) throw Refusal{kUtf16};
    if (!bytes.starts_with("glTF")) return {withoutMark(bytes), {}, false};
    Container container;
    std::string_view rest = withoutHeader(bytes);
    container.bytes_behind = bytes.size() - kHeaderBytes - rest.size();
    for (size_t index = 0; rest.size() >= kChunkHeaderBytes; ++index) {
        const uint32_t length = wordAt(rest, 0), type = wordAt(rest, 4);
        rest.remove_prefix(kChunkHeaderBytes);
        const std::string where = "chunk " + std::to_string(index);
        if (length > rest.size()) refuse(where, "is longer than the file", kCopyAgain);
        if (index == 0 && type != kJsonChunk) refuse(where, "is not JSON, as the first chunk must be");
        if (index == 0) container.json = withoutPadding(withoutMark(rest.substr(0, length)));
        if (type == kBinaryChunk && !container.has_binary) {
            container.binary = rest.substr(0, length);
            container.has_binary = true;
        }
        rest.remove_prefix(length);
    }
    if (container.json.empty()) refuse("chunk 0", "is missing or empty, must be JSON");
    return container;
}

} // namespace brittle::gltf
