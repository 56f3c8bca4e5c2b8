#include "engine/commands.h"

#include "engine/device.h"

#include <algorithm>
#include <array>

namespace engine {

namespace {

constexpr uint32_t kMaxGroupsPerDimension = 65535; // what every device has
constexpr VkDeviceSize kIndirectBytes = 3 * sizeof(uint32_t);

// All that a command recorded here may do.
constexpr VkPipelineStageFlags kStages =
    VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT | VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT;
constexpr VkAccessFlags kAccesses = VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_READ_BIT |
                                    VK_ACCESS_TRANSFER_WRITE_BIT | VK_ACCESS_INDIRECT_COMMAND_READ_BIT;

Access accessOf(const BufferView& view, bool write, VkPipelineStageFlags stage, VkAccessFlags mask) {
    return {view.buffer->handle(), view.offset, view.offset + view.size, write, stage, mask};
}

Access kernelAccess(const BufferView& view, const ReflectedBinding& binding) {
    const VkAccessFlags read = binding.writeonly ? 0 : VK_ACCESS_SHADER_READ_BIT;
    const VkAccessFlags write = binding.readonly ? 0 : VK_ACCESS_SHADER_WRITE_BIT;
    return accessOf(view, !binding.readonly, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, read | write);
}

bool fits(const BufferView& view) { return view.offset + view.size <= view.buffer->size(); }

} // namespace

Commands::Commands(Device& device) : device_(device), descriptors_(device), timestamps_(device, device.computeQueue()) {}

Commands::Commands(Device& device, VkCommandBuffer external) : Commands(device) {
    external_ = true;
    commands_ = external;
    recording_ = true;
}

Commands::~Commands() {
    if (pool_ != VK_NULL_HANDLE) device_.vk().vkDestroyCommandPool(device_.handle(), pool_, nullptr);
    if (fence_ != VK_NULL_HANDLE) device_.vk().vkDestroyFence(device_.handle(), fence_, nullptr);
}

Result<void> Commands::createOwn(bool secondary) {
    const VolkDeviceTable& vk = device_.vk();
    VkCommandPoolCreateInfo pool{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
    pool.queueFamilyIndex = device_.computeQueue().family;
    VkResult made = vk.vkCreateCommandPool(device_.handle(), &pool, nullptr, &pool_);
    if (made != VK_SUCCESS) return vulkanError("command pool", made);
    VkCommandBufferAllocateInfo commands{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
    commands.commandPool = pool_;
    commands.level = secondary ? VK_COMMAND_BUFFER_LEVEL_SECONDARY : VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    secondary_ = secondary;
    commands.commandBufferCount = 1;
    made = vk.vkAllocateCommandBuffers(device_.handle(), &commands, &commands_);
    if (made != VK_SUCCESS) return vulkanError("command buffer", made);
    const VkFenceCreateInfo fence{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
    made = vk.vkCreateFence(device_.handle(), &fence, nullptr, &fence_);
    if (made != VK_SUCCESS) return vulkanError("fence", made);
    return {};
}

Result<void> Commands::begin(Reuse reuse) {
    error_.reset();
    hazards_.flush();
    descriptors_.reset();
    pipelines_.clear();
    timestamps_.reset();
    dispatch_count_ = 0;
    barrier_count_ = 0;
    label_.clear();
    if (trace_) trace_->clear();
    probe_ = nullptr;
    probed_.reset();
    if (external_) return {};
    if (pool_ == VK_NULL_HANDLE) {
        if (auto made = createOwn(reuse == Reuse::ByOthers); !made) return made;
    }
    ENGINE_ASSERT(secondary_ == (reuse == Reuse::ByOthers));
    device_.vk().vkResetCommandPool(device_.handle(), pool_, 0);
    VkCommandBufferBeginInfo info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    if (reuse == Reuse::Once) info.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    const VkCommandBufferInheritanceInfo alone{VK_STRUCTURE_TYPE_COMMAND_BUFFER_INHERITANCE_INFO};
    if (secondary_) {
        info.flags = VK_COMMAND_BUFFER_USAGE_SIMULTANEOUS_USE_BIT;
        info.pInheritanceInfo = &alone;
    }
    const VkResult begun = device_.vk().vkBeginCommandBuffer(commands_, &info);
    if (begun != VK_SUCCESS) return vulkanError("cannot begin a command buffer", begun);
    recording_ = true;
    return {};
}

Result<void> Commands::submitAndWait() {
    if (auto submitted = submit(); !submitted) return submitted;
    return wait();
}

Result<void> Commands::submit() {
    ENGINE_ASSERT(!external_ && recording_);
    recording_ = false;
    if (timestamps_.open()) fail({ErrorCode::Internal, "a label is still open at the end of a recording"});
    flush();
    const VkResult ended = device_.vk().vkEndCommandBuffer(commands_);
    if (error_) return *error_;
    if (ended != VK_SUCCESS) return vulkanError("cannot end a command buffer", ended);
    return submitAgain();
}

Result<void> Commands::submitAgain() {
    ENGINE_ASSERT(!external_ && !recording_);
    if (error_) return *error_;
    device_.vk().vkResetFences(device_.handle(), 1, &fence_);
    return device_.submit(device_.computeQueue(), commands_, fence_);
}

Result<void> Commands::wait() {
    const VkResult waited = device_.vk().vkWaitForFences(device_.handle(), 1, &fence_, VK_TRUE, UINT64_MAX);
    if (waited != VK_SUCCESS) return vulkanError("waiting for the device " + device_.name(), waited);
    return {};
}

Result<void> Commands::end() {
    ENGINE_ASSERT(secondary_ && recording_);
    recording_ = false;
    flush();
    const VkResult ended = device_.vk().vkEndCommandBuffer(commands_);
    if (error_) return *error_;
    if (ended != VK_SUCCESS) return vulkanError("cannot end a command buffer", ended);
    return {};
}

void Commands::executeIn(VkCommandBuffer primary) const {
    ENGINE_ASSERT(secondary_ && !recording_);
    separate(primary);
    device_.vk().vkCmdExecuteCommands(primary, 1, &commands_);
}

void Commands::separate(VkCommandBuffer commands) const {
    const VkMemoryBarrier barrier{VK_STRUCTURE_TYPE_MEMORY_BARRIER, nullptr,
                                  VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT,
                                  VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT};
    device_.vk().vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, 0, 1,
                                      &barrier, 0, nullptr, 0, nullptr);
}

Result<void> Commands::status() const {
    if (error_) return *error_;
    return {};
}

void Commands::dispatch(const Kernel& kernel, uint32_t invocations, Bytes push, Views buffers) {
    const uint32_t size = kernel.reflection.local_size[0];
    if (invocations != 0) note(TracedCommand::Kind::Lanes, &kernel, invocations, buffers);
    dispatchGrid(kernel, invocations / size + (invocations % size != 0 ? 1 : 0), push, buffers);
}

void Commands::dispatchGroups(const Kernel& kernel, uint32_t groups, Bytes push, Views buffers) {
    if (groups != 0) note(TracedCommand::Kind::Groups, &kernel, groups, buffers);
    dispatchGrid(kernel, groups, push, buffers);
}

// More groups than one dimension takes are spread evenly over rows, so that less than a row's count of groups is too many.
void Commands::dispatchGrid(const Kernel& kernel, uint32_t groups, Bytes push, Views buffers) {
    if (groups == 0) {
        accepts(kernel, push, buffers);
        return;
    }
    if (!prepare(kernel, push, buffers, nullptr)) return;
    const uint32_t rows = (groups - 1) / kMaxGroupsPerDimension + 1;
    if (time_kernels_) beginSpan(kernel.name);
    device_.vk().vkCmdDispatch(commands_, (groups - 1) / rows + 1, rows, 1);
    if (time_kernels_) timestamps_.end(commands_);
    ++dispatch_count_;
    runAlone();
}

void Commands::dispatchIndirect(const Kernel& kernel, BufferView args, Bytes push, Views buffers) {
    if (args.buffer == nullptr || args.size < kIndirectBytes || args.offset % 4 != 0 || !fits(args)) {
        failKernel(kernel, "indirect arguments that are not three words of a buffer");
        return;
    }
    if (!prepare(kernel, push, buffers, &args)) return;
    note(TracedCommand::Kind::Indirect, &kernel, 0, buffers, args);
    if (time_kernels_) beginSpan(kernel.name);
    device_.vk().vkCmdDispatchIndirect(commands_, args.buffer->handle(), args.offset);
    if (time_kernels_) timestamps_.end(commands_);
    ++dispatch_count_;
    runAlone();
}

bool Commands::prepare(const Kernel& kernel, Bytes push, Views buffers, const BufferView* args) {
    if (!accepts(kernel, push, buffers)) return false;
    std::array<Access, kMaxBindings + 1> accesses;
    size_t count = 0;
    for (const BufferView& view : buffers) {
        accesses[count] = kernelAccess(view, kernel.reflection.bindings[count]);
        ++count;
    }
    if (args != nullptr) {
        const BufferView words = args->sub(0, kIndirectBytes);
        accesses[count++] = accessOf(words, false, VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT, VK_ACCESS_INDIRECT_COMMAND_READ_BIT);
    }
    declare({accesses.data(), count});
    const VolkDeviceTable& vk = device_.vk();
    vk.vkCmdBindPipeline(commands_, VK_PIPELINE_BIND_POINT_COMPUTE, kernel.pipeline->handle());
    if (pipelines_.empty() || pipelines_.back() != kernel.pipeline) pipelines_.push_back(kernel.pipeline);
    if (!push.empty()) {
        vk.vkCmdPushConstants(commands_, kernel.pipeline->layout(), VK_SHADER_STAGE_COMPUTE_BIT, 0, kernel.reflection.push_size,
                              push.data());
    }
    return bindBuffers(kernel, buffers);
}

bool Commands::accepts(const Kernel& kernel, Bytes push, Views buffers) {
    ENGINE_ASSERT(recording_);
    // C++ rounds a struct with 64-bit members up to 8 bytes, SPIR-V ends it with its last member.
    const size_t wanted = kernel.reflection.push_size;
    if (push.size() != wanted && push.size() != (wanted + 7) / 8 * 8) {
        failKernel(kernel, "push block of " + std::to_string(push.size()) + " bytes, it has " + std::to_string(wanted));
        return false;
    }
    if (buffers.size() != kernel.bufferCount()) {
        failKernel(kernel, std::to_string(buffers.size()) + " buffers, it binds " + std::to_string(kernel.bufferCount()));
        return false;
    }
    for (uint32_t slot = 0; slot < buffers.size(); ++slot) {
        if (!acceptsView(kernel, slot, buffers[slot])) return false;
    }
    return true;
}

bool Commands::acceptsView(const Kernel& kernel, uint32_t slot, const BufferView& view) {
    const VkPhysicalDeviceLimits& limits = device_.limits();
    std::string why;
    if (view.buffer == nullptr || view.size == 0)
        why = "is empty";
    else if (!fits(view))
        why = "ends past its buffer \"" + view.buffer->name() + "\"";
    else if (view.offset % kViewAlignment != 0)
        why = "starts at " + std::to_string(view.offset) + ", no multiple of " + std::to_string(kViewAlignment);
    else if (view.size > limits.maxStorageBufferRange)
        why = "has " + std::to_string(view.size) + " bytes, a binding holds " + std::to_string(limits.maxStorageBufferRange);
    if (why.empty()) return true;
    failKernel(kernel, "view " + std::to_string(slot) + " (" + kernel.reflection.bindings[slot].name + ") " + why);
    return false;
}

bool Commands::bindBuffers(const Kernel& kernel, Views buffers) {
    if (buffers.empty()) return true;
    std::array<VkDescriptorBufferInfo, kMaxBindings> infos;
    for (size_t i = 0; i < buffers.size(); ++i)
        infos[i] = {buffers[i].buffer->handle(), buffers[i].offset, buffers[i].size};
    VkWriteDescriptorSet write{VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
    write.descriptorCount = static_cast<uint32_t>(buffers.size());
    write.descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    write.pBufferInfo = infos.data();
    const VolkDeviceTable& vk = device_.vk();
    if (device_.hasPushDescriptors()) {
        vk.vkCmdPushDescriptorSetKHR(commands_, VK_PIPELINE_BIND_POINT_COMPUTE, kernel.pipeline->layout(), 0, 1, &write);
        return true;
    }
    auto set = descriptors_.allocate(kernel.pipeline->setLayout(), kernel.bufferCount());
    if (!set) {
        fail(set.error());
        return false;
    }
    write.dstSet = *set;
    vk.vkUpdateDescriptorSets(device_.handle(), 1, &write, 0, nullptr);
    vk.vkCmdBindDescriptorSets(commands_, VK_PIPELINE_BIND_POINT_COMPUTE, kernel.pipeline->layout(), 0, 1, &*set, 0, nullptr);
    return true;
}

void Commands::fill(BufferView target, uint32_t value) {
    if (target.size == 0) return;
    if (target.buffer == nullptr || target.offset % 4 != 0 || target.size % 4 != 0 || !fits(target)) {
        fail({ErrorCode::Internal, "fill of a view that is not whole words of a buffer"});
        return;
    }
    note(TracedCommand::Kind::Fill, nullptr, 0, {&target, 1});
    const Access access = accessOf(target, true, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_WRITE_BIT);
    declare({&access, 1});
    device_.vk().vkCmdFillBuffer(commands_, target.buffer->handle(), target.offset, target.size, value);
    runAlone();
}

void Commands::copy(BufferView source, BufferView target) {
    if (source.size == 0) return;
    if (source.buffer == nullptr || target.buffer == nullptr || target.size < source.size || !fits(source) || !fits(target)) {
        fail({ErrorCode::Internal, "copy of " + std::to_string(source.size) + " bytes to " + std::to_string(target.size)});
        return;
    }
    const BufferView both[] = {source, target};
    note(TracedCommand::Kind::Copy, nullptr, 0, both);
    const Access accesses[] = {
        accessOf(source, false, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_READ_BIT),
        accessOf(target.sub(0, source.size), true, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_WRITE_BIT)};
    declare(accesses);
    const VkBufferCopy region{source.offset, target.offset, source.size};
    device_.vk().vkCmdCopyBuffer(commands_, source.buffer->handle(), target.buffer->handle(), 1, &region);
    runAlone();
}

void Commands::update(BufferView target, Bytes bytes) {
    if (bytes.empty()) return;
    constexpr size_t kMost = 65536;
    const bool words = target.offset % 4 == 0 && bytes.size() % 4 == 0 && bytes.size() <= kMost;
    if (target.buffer == nullptr || !words || target.size < bytes.size() || !fits(target)) {
        fail({ErrorCode::Internal, "update of " + std::to_string(bytes.size()) + " bytes that are not words of a buffer"});
        return;
    }
    const BufferView part = target.sub(0, bytes.size());
    note(TracedCommand::Kind::Copy, nullptr, 0, {&part, 1});
    const Access access = accessOf(part, true, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_WRITE_BIT);
    declare({&access, 1});
    device_.vk().vkCmdUpdateBuffer(commands_, target.buffer->handle(), target.offset, bytes.size(), bytes.data());
    runAlone();
}

void Commands::beginLabel(std::string_view name) {
    if (timestamps_.open()) {
        fail({ErrorCode::Internal, "label \"" + std::string(name) + "\" begins inside another"});
        return;
    }
    label_ = name;
    if (!time_kernels_) beginSpan(name);
    if (!device_.hasDebugUtils() || probe_ != nullptr) return; // labels that span recordings make lavapipe crash
    const std::string terminated(name);
    VkDebugUtilsLabelEXT label{VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT};
    label.pLabelName = terminated.c_str();
    device_.instanceFunctions().vkCmdBeginDebugUtilsLabelEXT(commands_, &label);
}

void Commands::endLabel() {
    label_.clear();
    if (!time_kernels_) timestamps_.end(commands_);
    if (device_.hasDebugUtils() && probe_ == nullptr) device_.instanceFunctions().vkCmdEndDebugUtilsLabelEXT(commands_);
}

void Commands::beginSpan(std::string_view name) {
    if (secondary_ || probe_ != nullptr) return;
    if (auto begun = timestamps_.begin(commands_, name); !begun) fail(begun.error());
}

void Commands::note(TracedCommand::Kind kind, const Kernel* kernel, uint32_t count, Views buffers,
                    const BufferView& arguments) {
    if (!trace_ && probe_ == nullptr) return;
    TracedCommand command = {kind, label_, kernel, count, arguments, {buffers.begin(), buffers.end()}};
    if (probe_ != nullptr && !error_) {
        probed_ = command;
        if (auto shown = probe_->before(command); !shown) fail(shown.error());
    }
    if (trace_) trace_->push_back(std::move(command));
}

void Commands::flush() {
    const BarrierSource source = hazards_.flush();
    if (source.stages == 0) return;
    VkMemoryBarrier barrier{VK_STRUCTURE_TYPE_MEMORY_BARRIER};
    barrier.srcAccessMask = source.writes;
    barrier.dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT | VK_ACCESS_HOST_READ_BIT;
    device_.vk().vkCmdPipelineBarrier(commands_, source.stages, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT | VK_PIPELINE_STAGE_HOST_BIT,
                                      0, 1, &barrier, 0, nullptr, 0, nullptr);
}

void Commands::declare(std::span<const Access> accesses) {
    const auto source = hazards_.add(accesses);
    if (!source) return;
    VkMemoryBarrier barrier{VK_STRUCTURE_TYPE_MEMORY_BARRIER, nullptr, source->writes, kAccesses};
    device_.vk().vkCmdPipelineBarrier(commands_, source->stages, kStages, 0, 1, &barrier, 0, nullptr, 0, nullptr);
    ++barrier_count_;
}

void Commands::fail(Error error) {
    if (!error_) error_ = std::move(error);
}

void Commands::failKernel(const Kernel& kernel, const std::string& why) {
    fail({ErrorCode::Internal, "dispatch of \"" + kernel.name + "\": " + why});
}

} // namespace engine
