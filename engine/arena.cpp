#include "engine/arena.h"

#include "engine/device.h"

#include <algorithm>

namespace engine {

namespace {

constexpr VkDeviceSize kMinTake = 16;

// Kernels clear four words at a time.
VkDeviceSize rounded(VkDeviceSize bytes) { return (std::max(bytes, kMinTake) + 15) / 16 * 16; }

} // namespace

Result<ScratchArena> ScratchArena::create(Device& device, VkDeviceSize capacity, std::string_view name,
                                          VkBufferUsageFlags usage) {
    auto buffer = Buffer::create(device, capacity, BufferDomain::Device, usage, name);
    if (!buffer) return buffer.error();
    ScratchArena arena;
    arena.device_ = &device;
    arena.buffer_ = std::make_unique<Buffer>(std::move(*buffer));
    return arena;
}

BufferView ScratchArena::take(VkDeviceSize bytes) {
    const BufferView taken = takeInParts(bytes);
    largest_ = std::max(largest_, rounded(bytes));
    return taken;
}

BufferView ScratchArena::takeInParts(VkDeviceSize bytes) {
    const VkDeviceSize size = rounded(bytes);
    const VkDeviceSize begin = used_;
    used_ = (begin + size + kViewAlignment - 1) / kViewAlignment * kViewAlignment;
    peak_ = std::max(peak_, begin + size);
    if (begin + size > capacity()) {
        overflowed_ = true;
        return {};
    }
    return device_->gpuAssistedValidation() ? takeAlone(size) : BufferView(buffer_.get(), begin, size);
}

BufferView ScratchArena::takeAlone(VkDeviceSize size) {
    auto buffer = Buffer::create(*device_, size, BufferDomain::Device, buffer_->usage(), buffer_->name());
    if (!buffer) {
        overflowed_ = true;
        return {};
    }
    alone_.push_back(std::make_unique<Buffer>(std::move(*buffer)));
    return *alone_.back();
}

void ScratchArena::release(Mark mark) {
    ENGINE_ASSERT(mark <= used_);
    used_ = mark;
}

void ScratchArena::reset() {
    used_ = 0;
    peak_ = 0;
    largest_ = 0;
    overflowed_ = false;
    alone_.clear();
}

Result<void> ScratchArena::status() const {
    if (!overflowed_) return {};
    return Error{ErrorCode::Capacity, "arena \"" + buffer_->name() + "\" holds " + std::to_string(capacity()) + " bytes, " +
                                          std::to_string(peak_) + " are needed"};
}

} // namespace engine
