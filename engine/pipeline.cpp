#include "engine/pipeline.h"

#include "engine/device.h"
#include "engine/unchecked_kernels.h"

#include <cstddef>

namespace engine {
namespace {

VkShaderModuleCreateInfo codeOf(const PipelineSource& source) {
    VkShaderModuleCreateInfo code{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
    code.codeSize = source.words.size_bytes();
    code.pCode = source.words.data();
    return code;
}

// Without a module for a kernel that stays unchecked.
Result<VkShaderModule> moduleOf(const Device& device, const std::string& name, const VkShaderModuleCreateInfo& code) {
    VkShaderModule module = VK_NULL_HANDLE;
    if (leavesUnchecked(device, name)) return module;
    const VkResult made = device.vk().vkCreateShaderModule(device.handle(), &code, nullptr, &module);
    if (made != VK_SUCCESS) return vulkanError("module of kernel \"" + name + "\"", made);
    return module;
}

} // namespace

Result<std::shared_ptr<const Pipeline>> Pipeline::create(Device& device, const PipelineSource& source) {
    const std::shared_ptr<Pipeline> pipeline(new Pipeline(device));
    if (auto made = pipeline->makeLayouts(source); !made) return made.error();
    if (auto made = pipeline->make(source); !made) return made.error();
    return std::shared_ptr<const Pipeline>(pipeline);
}

Pipeline::~Pipeline() {
    const VolkDeviceTable& vk = device_.vk();
    vk.vkDestroyPipeline(device_.handle(), handle_, nullptr);
    vk.vkDestroyPipelineLayout(device_.handle(), layout_, nullptr);
    vk.vkDestroyDescriptorSetLayout(device_.handle(), set_layout_, nullptr);
}

Result<void> Pipeline::makeLayouts(const PipelineSource& source) {
    const VolkDeviceTable& vk = device_.vk();
    std::vector<VkDescriptorSetLayoutBinding> bindings;
    for (uint32_t i = 0; i < source.buffer_count; ++i)
        bindings.push_back({i, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr});
    VkDescriptorSetLayoutCreateInfo set{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
    set.flags = device_.hasPushDescriptors() ? VK_DESCRIPTOR_SET_LAYOUT_CREATE_PUSH_DESCRIPTOR_BIT_KHR : 0;
    set.bindingCount = source.buffer_count;
    set.pBindings = bindings.data();
    VkResult made = vk.vkCreateDescriptorSetLayout(device_.handle(), &set, nullptr, &set_layout_);
    if (made != VK_SUCCESS) return vulkanError("descriptor layout of kernel \"" + source.name + "\"", made);

    const VkPushConstantRange push{VK_SHADER_STAGE_COMPUTE_BIT, 0, source.push_size};
    VkPipelineLayoutCreateInfo layout{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
    layout.setLayoutCount = 1;
    layout.pSetLayouts = &set_layout_;
    layout.pushConstantRangeCount = push.size > 0 ? 1 : 0;
    layout.pPushConstantRanges = &push;
    made = vk.vkCreatePipelineLayout(device_.handle(), &layout, nullptr, &layout_);
    if (made != VK_SUCCESS) return vulkanError("layout of kernel \"" + source.name + "\"", made);
    return {};
}

Result<void> Pipeline::make(const PipelineSource& source) {
    const VkShaderModuleCreateInfo code = codeOf(source);
    const auto module = moduleOf(device_, source.name, code);
    if (!module) return module.error();
    const std::span<const SpecConstant> spec = source.constants;
    std::vector<VkSpecializationMapEntry> entries;
    for (uint32_t i = 0; i < spec.size(); ++i)
        entries.push_back({spec[i].id, static_cast<uint32_t>(i * sizeof(SpecConstant) + offsetof(SpecConstant, value)), 4});
    const VkSpecializationInfo constants{static_cast<uint32_t>(entries.size()), entries.data(), spec.size_bytes(), spec.data()};
    VkComputePipelineCreateInfo info{VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO};
    info.stage = {VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
                  *module == VK_NULL_HANDLE ? &code : nullptr,
                  0,
                  VK_SHADER_STAGE_COMPUTE_BIT,
                  *module,
                  "main",
                  spec.empty() ? nullptr : &constants};
    info.layout = layout_;
    const VolkDeviceTable& vk = device_.vk();
    const VkResult made = vk.vkCreateComputePipelines(device_.handle(), device_.pipelineCache(), 1, &info, nullptr, &handle_);
    vk.vkDestroyShaderModule(device_.handle(), *module, nullptr);
    if (made != VK_SUCCESS) return vulkanError("pipeline of kernel \"" + source.name + "\"", made);
    device_.setName(VK_OBJECT_TYPE_PIPELINE, reinterpret_cast<uint64_t>(handle_), source.name);
    return {};
}

SharedPipelines::Key SharedPipelines::keyOf(std::span<const uint32_t> words, std::span<const SpecConstant> constants) {
    return {{words.begin(), words.end()}, {constants.begin(), constants.end()}};
}

bool SharedPipelines::has(std::span<const uint32_t> words, std::span<const SpecConstant> constants) const {
    const std::lock_guard lock(mutex_);
    return pipelines_.contains(keyOf(words, constants));
}

Result<std::shared_ptr<const Pipeline>> SharedPipelines::get(const PipelineSource& source, const Make& make) {
    Key key = keyOf(source.words, source.constants);
    {
        const std::lock_guard lock(mutex_);
        if (const auto found = pipelines_.find(key); found != pipelines_.end()) return found->second;
    }
    auto made = make(); // outside the lock, so that several can be made at a time
    if (!made) return made;
    const std::lock_guard lock(mutex_);
    return pipelines_.try_emplace(std::move(key), std::move(*made)).first->second;
}

} // namespace engine
