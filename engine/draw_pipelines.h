// The renderer's fixed objects: render pass, layouts, and the pipelines of shaders-spirv/draw.
#pragma once

#include "engine/vulkan.h"

#include <array>
#include <string_view>

namespace engine {

class Device;

class DrawPipelines {
public:
    explicit DrawPipelines(Device& device) : device_(device) {}
    ~DrawPipelines();
    DrawPipelines(const DrawPipelines&) = delete;
    DrawPipelines& operator=(const DrawPipelines&) = delete;

    Result<void> create(VkFormat color, VkFormat depth);

    VkRenderPass renderPass() const { return render_pass_; }
    VkPipelineLayout layout() const { return layout_; }
    VkDescriptorSetLayout setLayout() const { return set_layout_; } // matrices, colors
    VkPipeline background() const { return background_; }
    VkPipeline fragments() const { return fragments_; }

private:
    Result<void> createRenderPass(VkFormat color, VkFormat depth);
    Result<void> createLayouts();
    Result<VkShaderModule> loadShader(std::string_view name) const;
    Result<VkPipeline> createPipeline(std::string_view vertex, std::string_view fragment, bool with_vertices) const;
    Result<VkPipeline> assemble(const std::array<VkShaderModule, 2>& modules, bool with_vertices) const;

    Device& device_;
    VkRenderPass render_pass_ = VK_NULL_HANDLE;
    VkDescriptorSetLayout set_layout_ = VK_NULL_HANDLE;
    VkPipelineLayout layout_ = VK_NULL_HANDLE;
    VkPipeline background_ = VK_NULL_HANDLE, fragments_ = VK_NULL_HANDLE;
};

} // namespace engine
