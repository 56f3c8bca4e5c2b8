// Buffers say what they are for; views are ranges of them.
#pragma once

#include "engine/memory.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace engine {

enum class BufferDomain {
    Device,   // kernels read and write it
    Upload,   // the host writes it, kernels and copies read it
    Readback, // kernels and copies write it, the host reads it, through its cache
};

class Buffer {
public:
    // Every buffer may be bound as storage, copied from and to, and hold indirect arguments; `usage` adds to that.
    static Result<Buffer> create(Device& device, VkDeviceSize size, BufferDomain domain, VkBufferUsageFlags usage = 0,
                                 std::string_view name = {});
    Buffer() = default;
    ~Buffer() { destroy(); }
    Buffer(Buffer&& other) noexcept { swap(other); }
    Buffer& operator=(Buffer&& other) noexcept {
        Buffer moved(std::move(other));
        swap(moved);
        return *this;
    }

    VkBuffer handle() const { return handle_; }
    VkDeviceSize size() const { return size_; }
    VkBufferUsageFlags usage() const { return usage_; }
    const std::string& name() const { return name_; }
    // Upload and Readback only; stays mapped for the life of the buffer.
    std::byte* mapped() const { return mapped_; }
    template <class T>
    T* mappedAs() const {
        return reinterpret_cast<T*>(mapped_);
    }

private:
    void destroy();
    void swap(Buffer& other) noexcept;

    Device* device_ = nullptr;
    VkBuffer handle_ = VK_NULL_HANDLE;
    VkDeviceSize size_ = 0;
    VkBufferUsageFlags usage_ = 0;
    MemoryShare memory_;
    std::byte* mapped_ = nullptr;
    std::string name_;
};

// Views that kernels are given begin at multiples of it: no device asks for more (Vulkan, minStorageBufferOffsetAlignment),
// most for less, and what works on one has to work on all.
constexpr VkDeviceSize kViewAlignment = 256;

struct BufferView {
    const Buffer* buffer = nullptr;
    VkDeviceSize offset = 0;
    VkDeviceSize size = 0;

    BufferView() = default;
    BufferView(const Buffer& whole) : buffer(&whole), size(whole.size()) {}
    BufferView(const Buffer* of, VkDeviceSize from, VkDeviceSize bytes) : buffer(of), offset(from), size(bytes) {}

    BufferView sub(VkDeviceSize from, VkDeviceSize bytes) const { return {buffer, offset + from, bytes}; }
};

} // namespace engine
