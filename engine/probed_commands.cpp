// How a recording is run command by command, for a probe.
#include "engine/commands.h"
#include "engine/device.h"

#include <utility>

namespace engine {

void Commands::runAlone() {
    if (!probed_) return;
    const TracedCommand command = *std::exchange(probed_, std::nullopt);
    if (error_) return;
    if (auto ran = runRecorded(); !ran) return fail(ran.error());
    if (auto shown = probe_->after(command); !shown) fail(shown.error());
}

// Submits what has been recorded so far, and goes on in the same command buffer once the device has finished.
Result<void> Commands::runRecorded() {
    ENGINE_ASSERT(!external_ && !secondary_ && recording_);
    flush();
    const VolkDeviceTable& vk = device_.vk();
    if (const VkResult ended = vk.vkEndCommandBuffer(commands_); ended != VK_SUCCESS)
        return vulkanError("cannot end a command buffer", ended);
    vk.vkResetFences(device_.handle(), 1, &fence_);
    if (auto submitted = device_.submit(device_.computeQueue(), commands_, fence_); !submitted) return submitted;
    if (auto waited = wait(); !waited) return waited;
    descriptors_.reset();
    pipelines_.clear();
    vk.vkResetCommandPool(device_.handle(), pool_, 0);
    const VkCommandBufferBeginInfo info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO, nullptr,
                                        VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT, nullptr};
    if (const VkResult begun = vk.vkBeginCommandBuffer(commands_, &info); begun != VK_SUCCESS)
        return vulkanError("cannot begin a command buffer", begun);
    return {};
}

} // namespace engine
