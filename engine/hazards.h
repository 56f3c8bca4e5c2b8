// Derives barriers from what each command reads and writes. Knows nothing of command buffers.
#pragma once

#include "engine/vulkan.h"

#include <optional>
#include <span>
#include <vector>

namespace engine {

// One range of a buffer that one command touches.
struct Access {
    VkBuffer buffer = VK_NULL_HANDLE;
    VkDeviceSize begin = 0, end = 0;
    bool write = false;
    VkPipelineStageFlags stage = 0;
    VkAccessFlags mask = 0;
};

// Which earlier work a barrier has to wait for.
struct BarrierSource {
    VkPipelineStageFlags stages = 0;
    VkAccessFlags writes = 0;
};

class HazardTracker {
public:
    // Remembers a command. Says what has to be waited for before it, where it meets a range since the last barrier that it
    // must not meet (read after write, write after read, write after write); what came before the barrier is forgotten.
    std::optional<BarrierSource> add(std::span<const Access> accesses);

    // All that was remembered, then forgets it.
    BarrierSource flush();
    bool empty() const { return past_.empty(); }

private:
    bool conflicts(const Access& access) const;
    std::vector<Access> past_;
};

} // namespace engine
