#include "engine/draw_pipelines.h"

#include "engine/device.h"
#include "shaders-spirv/embedded.h"
#include "shaders-spirv/shared/scene.h"

#include <cstddef>

namespace engine {

namespace {

constexpr VkShaderStageFlags kPushStages = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;

VkAttachmentDescription attachment(VkFormat format, VkAttachmentStoreOp store, VkImageLayout last) {
    VkAttachmentDescription description{};
    description.format = format;
    description.samples = VK_SAMPLE_COUNT_1_BIT;
    description.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    description.storeOp = store;
    description.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    description.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    description.finalLayout = last;
    return description;
}

// Before the pass: the copy of the last picture has been read. After it: this picture is copied.
std::array<VkSubpassDependency, 2> dependencies() {
    constexpr VkPipelineStageFlags kDepth =
        VK_PIPELINE_STAGE_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_LATE_FRAGMENT_TESTS_BIT;
    constexpr VkPipelineStageFlags kColor = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT;
    constexpr VkAccessFlags kWrites = VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT | VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;
    constexpr VkAccessFlags kReads = VK_ACCESS_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_READ_BIT;
    return {{{VK_SUBPASS_EXTERNAL, 0, kColor | kDepth | VK_PIPELINE_STAGE_TRANSFER_BIT, kColor | kDepth, kWrites,
              kWrites | kReads, 0},
             {0, VK_SUBPASS_EXTERNAL, kColor, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT,
              VK_ACCESS_TRANSFER_READ_BIT, 0}}};
}

// The fixed stages. Closed pieces are drawn from outside, with depth; the background is one triangle without vertices,
// behind all.
struct PipelineState {
    explicit PipelineState(bool with_vertices) {
        input.vertexBindingDescriptionCount = with_vertices ? 1 : 0;
        input.pVertexBindingDescriptions = &binding;
        input.vertexAttributeDescriptionCount = with_vertices ? 2 : 0;
        input.pVertexAttributeDescriptions = attributes;
        assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
        viewport.viewportCount = viewport.scissorCount = 1;
        raster.cullMode = with_vertices ? VK_CULL_MODE_BACK_BIT : VK_CULL_MODE_NONE;
        raster.frontFace = VK_FRONT_FACE_COUNTER_CLOCKWISE;
        raster.lineWidth = 1;
        samples.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
        depth.depthTestEnable = depth.depthWriteEnable = with_vertices ? VK_TRUE : VK_FALSE;
        depth.depthCompareOp = VK_COMPARE_OP_LESS;
        write.colorWriteMask = 0xf;
        write.blendEnable = with_vertices ? VK_TRUE : VK_FALSE;
        write.srcColorBlendFactor = VK_BLEND_FACTOR_SRC_ALPHA;
        write.dstColorBlendFactor = write.dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA;
        write.srcAlphaBlendFactor = VK_BLEND_FACTOR_ONE;
        blend.attachmentCount = 1;
        blend.pAttachments = &write;
        dynamic.dynamicStateCount = 2;
        dynamic.pDynamicStates = dynamic_states;
    }
    PipelineState(const PipelineState&) = delete; // points into itself
    PipelineState& operator=(const PipelineState&) = delete;

    VkVertexInputBindingDescription binding{0, sizeof(gpu::SceneVertex), VK_VERTEX_INPUT_RATE_VERTEX};
    VkVertexInputAttributeDescription attributes[2] = {{0, 0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(gpu::SceneVertex, position)},
                                                       {1, 0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(gpu::SceneVertex, normal)}};
    VkDynamicState dynamic_states[2] = {VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
    VkPipelineColorBlendAttachmentState write{};
    VkPipelineVertexInputStateCreateInfo input{VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO};
    VkPipelineInputAssemblyStateCreateInfo assembly{VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO};
    VkPipelineViewportStateCreateInfo viewport{VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO};
    VkPipelineRasterizationStateCreateInfo raster{VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO};
    VkPipelineMultisampleStateCreateInfo samples{VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO};
    VkPipelineDepthStencilStateCreateInfo depth{VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO};
    VkPipelineColorBlendStateCreateInfo blend{VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO};
    VkPipelineDynamicStateCreateInfo dynamic{VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO};
};

} // namespace

DrawPipelines::~DrawPipelines() {
    const VolkDeviceTable& vk = device_.vk();
    vk.vkDestroyPipeline(device_.handle(), fragments_, nullptr);
    vk.vkDestroyPipeline(device_.handle(), background_, nullptr);
    vk.vkDestroyPipelineLayout(device_.handle(), layout_, nullptr);
    vk.vkDestroyDescriptorSetLayout(device_.handle(), set_layout_, nullptr);
    vk.vkDestroyRenderPass(device_.handle(), render_pass_, nullptr);
}

Result<void> DrawPipelines::create(VkFormat color, VkFormat depth) {
    if (auto made = createRenderPass(color, depth); !made) return made;
    if (auto made = createLayouts(); !made) return made;
    auto background = createPipeline("background.vert", "background.frag", false);
    if (!background) return background.error();
    background_ = *background;
    auto fragments = createPipeline("fragment_mesh.vert", "fragment_mesh.frag", true);
    if (!fragments) return fragments.error();
    fragments_ = *fragments;
    return {};
}

Result<void> DrawPipelines::createRenderPass(VkFormat color, VkFormat depth) {
    const VkAttachmentDescription attachments[] = {
        attachment(color, VK_ATTACHMENT_STORE_OP_STORE, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL),
        attachment(depth, VK_ATTACHMENT_STORE_OP_DONT_CARE, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL)};
    const VkAttachmentReference color_reference{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    const VkAttachmentReference depth_reference{1, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass{};
    subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &color_reference;
    subpass.pDepthStencilAttachment = &depth_reference;
    const auto order = dependencies();
    VkRenderPassCreateInfo info{VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO};
    info.attachmentCount = 2;
    info.pAttachments = attachments;
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    info.dependencyCount = static_cast<uint32_t>(order.size());
    info.pDependencies = order.data();
    const VkResult made = device_.vk().vkCreateRenderPass(device_.handle(), &info, nullptr, &render_pass_);
    if (made != VK_SUCCESS) return vulkanError("render pass", made);
    return {};
}

Result<void> DrawPipelines::createLayouts() {
    const VkDescriptorSetLayoutBinding objects[] = {{0, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, kPushStages, nullptr},
                                                    {1, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, kPushStages, nullptr}};
    VkDescriptorSetLayoutCreateInfo set{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
    set.bindingCount = 2;
    set.pBindings = objects;
    VkResult made = device_.vk().vkCreateDescriptorSetLayout(device_.handle(), &set, nullptr, &set_layout_);
    if (made != VK_SUCCESS) return vulkanError("descriptor layout of the renderer", made);
    const VkPushConstantRange push{kPushStages, 0, sizeof(gpu::DrawPush)};
    VkPipelineLayoutCreateInfo layout{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
    layout.setLayoutCount = 1;
    layout.pSetLayouts = &set_layout_;
    layout.pushConstantRangeCount = 1;
    layout.pPushConstantRanges = &push;
    made = device_.vk().vkCreatePipelineLayout(device_.handle(), &layout, nullptr, &layout_);
    if (made != VK_SUCCESS) return vulkanError("layout of the renderer", made);
    return {};
}

Result<VkShaderModule> DrawPipelines::loadShader(std::string_view name) const {
    const shaders::Module* found = shaders::find(name);
    if (found == nullptr) return Error{ErrorCode::Internal, "no shader is named \"" + std::string(name) + "\""};
    VkShaderModuleCreateInfo info{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
    info.codeSize = found->words.size_bytes();
    info.pCode = found->words.data();
    VkShaderModule module = VK_NULL_HANDLE;
    const VkResult made = device_.vk().vkCreateShaderModule(device_.handle(), &info, nullptr, &module);
    if (made != VK_SUCCESS) return vulkanError("shader \"" + std::string(name) + "\"", made);
    return module;
}

Result<VkPipeline> DrawPipelines::createPipeline(std::string_view vertex, std::string_view fragment, bool with_vertices) const {
    auto first = loadShader(vertex);
    if (!first) return first.error();
    auto second = loadShader(fragment);
    auto pipeline = second ? assemble({*first, *second}, with_vertices) : Result<VkPipeline>(second.error());
    if (second) device_.vk().vkDestroyShaderModule(device_.handle(), *second, nullptr);
    device_.vk().vkDestroyShaderModule(device_.handle(), *first, nullptr);
    return pipeline;
}

Result<VkPipeline> DrawPipelines::assemble(const std::array<VkShaderModule, 2>& modules, bool with_vertices) const {
    VkPipelineShaderStageCreateInfo stages[2] = {};
    for (size_t i = 0; i < 2; ++i) {
        stages[i].sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
        stages[i].stage = i == 0 ? VK_SHADER_STAGE_VERTEX_BIT : VK_SHADER_STAGE_FRAGMENT_BIT;
        stages[i].module = modules[i];
        stages[i].pName = "main";
    }
    const PipelineState state(with_vertices);
    VkGraphicsPipelineCreateInfo info{VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO};
    info.stageCount = 2;
    info.pStages = stages;
    info.pVertexInputState = &state.input;
    info.pInputAssemblyState = &state.assembly;
    info.pViewportState = &state.viewport;
    info.pRasterizationState = &state.raster;
    info.pMultisampleState = &state.samples;
    info.pDepthStencilState = &state.depth;
    info.pColorBlendState = &state.blend;
    info.pDynamicState = &state.dynamic;
    info.layout = layout_;
    info.renderPass = render_pass_;
    VkPipeline pipeline = VK_NULL_HANDLE;
    const VkResult made =
        device_.vk().vkCreateGraphicsPipelines(device_.handle(), device_.pipelineCache(), 1, &info, nullptr, &pipeline);
    if (made != VK_SUCCESS) return vulkanError("pipeline of the renderer", made);
    return pipeline;
}

} // namespace engine
