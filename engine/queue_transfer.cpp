// How buffers pass from the compute queue to the graphics queue, if these are of different families.
#include "engine/commands.h"
#include "engine/device.h"

namespace engine {

namespace {

VkBufferMemoryBarrier transferOf(const Device& device, const BufferView& view) {
    VkBufferMemoryBarrier barrier{VK_STRUCTURE_TYPE_BUFFER_MEMORY_BARRIER};
    barrier.srcQueueFamilyIndex = device.computeQueue().family;
    barrier.dstQueueFamilyIndex = device.graphicsQueue().family;
    barrier.buffer = view.buffer->handle();
    barrier.offset = view.offset;
    barrier.size = view.size;
    return barrier;
}

} // namespace

void Commands::releaseToGraphics(std::span<const BufferView> buffers) {
    if (device_.sharesQueueFamily() || !device_.hasGraphics()) return;
    flush();
    std::vector<VkBufferMemoryBarrier> barriers;
    for (const BufferView& view : buffers) {
        barriers.push_back(transferOf(device_, view));
        barriers.back().srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT;
    }
    device_.vk().vkCmdPipelineBarrier(commands_, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, 0, 0,
                                      nullptr, static_cast<uint32_t>(barriers.size()), barriers.data(), 0, nullptr);
}

void Commands::acquireFromCompute(const Device& device, VkCommandBuffer graphics, std::span<const BufferView> buffers) {
    if (device.sharesQueueFamily()) return;
    std::vector<VkBufferMemoryBarrier> barriers;
    for (const BufferView& view : buffers) {
        barriers.push_back(transferOf(device, view));
        barriers.back().dstAccessMask = VK_ACCESS_MEMORY_READ_BIT;
    }
    device.vk().vkCmdPipelineBarrier(graphics, VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, 0, 0,
                                     nullptr, static_cast<uint32_t>(barriers.size()), barriers.data(), 0, nullptr);
}

} // namespace engine
