// Bytes of buffers and buffer views. Files and data: URIs are read on first use.
#pragma once

#include "modules/brittle/mesh/gltf/element.h"
#include "modules/brittle/mesh/gltf/gltf.h"

#include <map>

namespace brittle::gltf {

struct BufferView {
    std::string_view bytes;
    std::optional<uint64_t> stride; // as given; elements are packed without it
};

class Buffers {
public:
    // `binary` is the BIN chunk, nullopt without one. The document and the chunk must outlive this.
    Buffers(const Document& document, std::optional<std::string_view> binary, const ReadNeighbor& read_neighbor);

    // The decompressed bytes of a view; they live as long as this. `user` is the place that refers to it.
    BufferView view(uint64_t index, const std::string& user);
    // Bytes of the file and of all buffers that were read so far: a measure for counts that have no data of their own.
    uint64_t bytesRead() const { return bytes_read_; }
    void countBytes(uint64_t bytes) { bytes_read_ += bytes; }

private:
    std::string_view buffer(uint64_t index, const std::string& user);
    std::string_view load(const Element& buffer, uint64_t index);
    std::string readFile(const Element& buffer, const std::string& uri);
    // The part of a buffer that a view or its compressed form names.
    std::string_view range(const Element& view);

    const Document& document_;
    std::optional<std::string_view> binary_;
    const ReadNeighbor& read_neighbor_;
    std::map<uint64_t, std::string_view> buffers_;
    std::map<uint64_t, std::string> owned_, decoded_; // by buffer, by view
    uint64_t bytes_read_ = 0;
};

} // namespace brittle::gltf
