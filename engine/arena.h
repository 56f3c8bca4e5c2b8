// The general buffer: scratch memory of one event or frame. What is taken between mark() and release() shares its memory
// with what is taken afterwards; the barriers that Commands derives keep the two apart.
#pragma once

#include "engine/buffer.h"

#include <memory>
#include <vector>

namespace engine {

class ScratchArena {
public:
    using Mark = VkDeviceSize;

    // The capacity is fixed: plan it first. `usage`: beside what every buffer is for.
    static Result<ScratchArena> create(Device& device, VkDeviceSize capacity, std::string_view name = "scratch",
                                       VkBufferUsageFlags usage = 0);

    // A range that can be bound as storage, of a multiple of 16 bytes and not less than that. Where it does not fit the view is
    // empty and status() fails until the next reset(); taking goes on, so that the message names all that would have been
    // needed.
    BufferView take(VkDeviceSize bytes);
    // The same for a range of which kernels bind parts only: largest() does not count it.
    BufferView takeInParts(VkDeviceSize bytes);
    Mark mark() const { return used_; }
    void release(Mark mark);
    void reset();

    Result<void> status() const;
    VkDeviceSize capacity() const { return buffer_->size(); }
    VkDeviceSize used() const { return used_; }
    VkDeviceSize peak() const { return peak_; }       // the most that was in use at a time, also what did not fit
    VkDeviceSize largest() const { return largest_; } // of the ranges taken, also of those that did not fit
    const Buffer& buffer() const { return *buffer_; }

private:
    ScratchArena() = default;
    BufferView takeAlone(VkDeviceSize size);

    Device* device_ = nullptr;
    std::unique_ptr<Buffer> buffer_; // views point at it, also when the arena is moved
    // Under GPU-assisted validation every range is a buffer of its own until the next reset(), for the layer sees only
    // accesses past the end of a buffer.
    std::vector<std::unique_ptr<Buffer>> alone_;
    VkDeviceSize used_ = 0;
    VkDeviceSize peak_ = 0;
    VkDeviceSize largest_ = 0;
    bool overflowed_ = false;
};

} // namespace engine
