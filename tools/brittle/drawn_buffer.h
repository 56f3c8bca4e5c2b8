// What the renderer draws from, written by the host.
#pragma once

#include "engine/buffer.h"

#include <cstring>
#include <span>
#include <vector>

namespace cli {

// Stays writable: Buffer::mapped.
template <class T>
engine::Result<engine::Buffer> drawnBuffer(engine::Device& device, const std::vector<T>& values, VkBufferUsageFlags usage) {
    const std::span bytes = std::as_bytes(std::span(values));
    auto buffer = engine::Buffer::create(device, bytes.size(), engine::BufferDomain::Upload, usage, "picture");
    if (buffer) std::memcpy(buffer->mapped(), bytes.data(), bytes.size());
    return buffer;
}

} // namespace cli
