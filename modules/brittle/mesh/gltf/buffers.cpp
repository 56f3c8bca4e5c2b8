#include "modules/brittle/mesh/gltf/buffers.h"

#include "modules/brittle/mesh/gltf/meshopt.h"
#include "modules/brittle/mesh/gltf/uri.h"

namespace brittle::gltf {

Buffers::Buffers(const Document& document, std::optional<std::string_view> binary, const ReadNeighbor& read_neighbor)
    : document_(document), binary_(binary), read_neighbor_(read_neighbor) {}

BufferView Buffers::view(uint64_t index, const std::string& user) {
    const Element view = document_.element("bufferViews", index, user);
    const auto compressed = view.extension(kMeshopt);
    if (!compressed) return {range(view), view.integer("byteStride")};
    auto decoded = decoded_.find(index);
    if (decoded == decoded_.end()) decoded = decoded_.emplace(index, decodeMeshopt(*compressed, range(*compressed))).first;
    return {decoded->second, compressed->integer("byteStride")};
}

std::string_view Buffers::range(const Element& view) {
    const std::string_view bytes = buffer(view.requiredInteger("buffer"), view.where());
    const uint64_t offset = view.integer("byteOffset").value_or(0), length = view.requiredInteger("byteLength");
    if (offset > bytes.size() || length > bytes.size() - offset)
        view.refuse("byteOffset " + std::to_string(offset) + " and byteLength " + std::to_string(length) +
                    " reach beyond the buffer, which has " + std::to_string(bytes.size()) + " bytes");
    return bytes.substr(offset, length);
}

std::string_view Buffers::buffer(uint64_t index, const std::string& user) {
    const auto known = buffers_.find(index);
    if (known != buffers_.end()) return known->second;
    const Element buffer = document_.element("buffers", index, user);
    const uint64_t length = buffer.requiredInteger("byteLength");
    const std::string_view bytes = load(buffer, index);
    if (bytes.size() < length)
        buffer.refuse("byteLength is " + std::to_string(length) + ", its data has " + std::to_string(bytes.size()) + " bytes",
                      "copy or export the file again");
    return buffers_[index] = bytes.substr(0, length);
}

std::string_view Buffers::load(const Element& buffer, uint64_t index) {
    const auto uri = buffer.text("uri");
    if (!uri) {
        const auto extension = buffer.extension(kMeshopt);
        if (extension && extension->flag("fallback")) buffer.refuse("it has no data, yet a view without compression uses it");
        if (index == 0 && binary_) return *binary_;
        buffer.refuse("it has no uri, and the file has no BIN chunk for it");
    }
    std::string& bytes = owned_[index];
    bytes = isDataUri(*uri) ? decodeDataUri(*uri, buffer.where()) : readFile(buffer, *uri);
    bytes_read_ += bytes.size();
    return bytes;
}

std::string Buffers::readFile(const Element& buffer, const std::string& uri) {
    if (isAbsolute(uri))
        buffer.refuse("its uri \"" + withEscapes(uri) + "\" is not relative to the file",
                      "put the buffer beside the file and name it so");
    const std::string path = decodePercent(uri);
    if (path.find('\0') != path.npos)
        buffer.refuse("its uri \"" + withEscapes(uri) + "\" holds a zero byte, which no name of a file has",
                      "rename the buffer");
    auto bytes = read_neighbor_(path);
    if (!bytes && path != uri) // some programs write a name with % as it is
        if (auto literal = read_neighbor_(uri)) bytes = std::move(literal);
    if (!bytes) buffer.refuse("its file \"" + withEscapes(path) + "\": " + bytes.error().message, "put it beside the model");
    return std::move(*bytes);
}

} // namespace brittle::gltf
