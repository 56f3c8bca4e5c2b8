#include "engine/renderer.h"

#include "engine/commands.h"
#include "engine/device.h"
#include "engine/draw_pipelines.h"
#include "engine/image.h"

#include <algorithm>
#include <cstring>

namespace engine {

namespace {

constexpr uint32_t kSupersample = 2; // in each direction; averaged in linear light by the copy
constexpr VkFormat kColorFormat = VK_FORMAT_R8G8B8A8_SRGB;
constexpr VkFormat kDepthFormat = VK_FORMAT_D32_SFLOAT;
constexpr VkDeviceSize kCommandBytes = sizeof(gpu::DrawCommand);
static_assert(kCommandBytes == sizeof(VkDrawIndexedIndirectCommand));
static_assert(sizeof(gpu::DrawPush) == 128);

class OffscreenRenderer : public Renderer {
public:
    OffscreenRenderer(Device& device, uint32_t width, uint32_t height)
        : device_(device), vk_(device.vk()), width_(width), height_(height), pipelines_(device) {}
    ~OffscreenRenderer() override;
    OffscreenRenderer(const OffscreenRenderer&) = delete;
    OffscreenRenderer& operator=(const OffscreenRenderer&) = delete;

    Result<void> createAll();
    Result<Picture> draw(const DrawScene& scene, const Camera& camera, const Look& look,
                         std::span<const BufferView> released) override;

private:
    Result<void> createTargets();
    Result<void> createCommands();
    Result<void> createDescriptors();
    Result<void> check(const DrawScene& scene) const;
    void bindObjects(const DrawScene& scene);
    void recordScene(const DrawScene& scene, const gpu::DrawPush& push);
    void recordDraws(const DrawScene& scene);
    void recordReadback();
    gpu::DrawPush pushOf(const Camera& camera, const Look& look, bool own_colors) const;
    Picture picture() const;

    Device& device_;
    const VolkDeviceTable& vk_;
    uint32_t width_, height_;
    DrawPipelines pipelines_;
    Image color_, depth_, resolved_;
    Buffer readback_;
    VkFramebuffer framebuffer_ = VK_NULL_HANDLE;
    VkDescriptorPool descriptors_ = VK_NULL_HANDLE;
    VkDescriptorSet set_ = VK_NULL_HANDLE;
    VkCommandPool pool_ = VK_NULL_HANDLE;
    VkCommandBuffer commands_ = VK_NULL_HANDLE;
    VkFence fence_ = VK_NULL_HANDLE;
};

template <class T>
Result<void> store(Result<T> made, T& place) {
    if (!made) return made.error();
    place = std::move(*made);
    return {};
}

VkImageMemoryBarrier transition(VkImage image, VkImageLayout from, VkImageLayout to, VkAccessFlags before,
                                VkAccessFlags after) {
    VkImageMemoryBarrier barrier{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER};
    barrier.srcAccessMask = before;
    barrier.dstAccessMask = after;
    barrier.oldLayout = from;
    barrier.newLayout = to;
    barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.image = image;
    barrier.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    return barrier;
}

OffscreenRenderer::~OffscreenRenderer() {
    vk_.vkDestroyFence(device_.handle(), fence_, nullptr);
    vk_.vkDestroyCommandPool(device_.handle(), pool_, nullptr);
    vk_.vkDestroyDescriptorPool(device_.handle(), descriptors_, nullptr);
    vk_.vkDestroyFramebuffer(device_.handle(), framebuffer_, nullptr);
}

Result<void> OffscreenRenderer::createAll() {
    auto made = pipelines_.create(kColorFormat, kDepthFormat);
    if (made) made = createTargets();
    if (made) made = createCommands();
    if (made) made = createDescriptors();
    return made;
}

Result<void> OffscreenRenderer::createTargets() {
    const uint32_t wide = width_ * kSupersample, high = height_ * kSupersample;
    constexpr VkImageUsageFlags kColorUsage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
    constexpr VkImageUsageFlags kCopyUsage = VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
    auto made = store(Image::create(device_, wide, high, kColorFormat, kColorUsage, "color"), color_);
    if (made)
        made = store(Image::create(device_, wide, high, kDepthFormat, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT, "depth"),
                     depth_);
    if (made) made = store(Image::create(device_, width_, height_, kColorFormat, kCopyUsage, "resolved"), resolved_);
    if (made) {
        const VkDeviceSize bytes = VkDeviceSize(4) * width_ * height_;
        made = store(Buffer::create(device_, bytes, BufferDomain::Readback, 0, "picture"), readback_);
    }
    if (!made) return made;
    const VkImageView views[] = {color_.view(), depth_.view()};
    VkFramebufferCreateInfo info{VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO};
    info.renderPass = pipelines_.renderPass();
    info.attachmentCount = 2;
    info.pAttachments = views;
    info.width = wide;
    info.height = high;
    info.layers = 1;
    const VkResult result = vk_.vkCreateFramebuffer(device_.handle(), &info, nullptr, &framebuffer_);
    if (result != VK_SUCCESS) return vulkanError("framebuffer", result);
    return {};
}

Result<void> OffscreenRenderer::createCommands() {
    VkCommandPoolCreateInfo pool{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
    pool.queueFamilyIndex = device_.graphicsQueue().family;
    VkResult made = vk_.vkCreateCommandPool(device_.handle(), &pool, nullptr, &pool_);
    if (made != VK_SUCCESS) return vulkanError("command pool of the renderer", made);
    const VkCommandBufferAllocateInfo commands{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO, nullptr, pool_,
                                               VK_COMMAND_BUFFER_LEVEL_PRIMARY, 1};
    made = vk_.vkAllocateCommandBuffers(device_.handle(), &commands, &commands_);
    if (made != VK_SUCCESS) return vulkanError("command buffer of the renderer", made);
    const VkFenceCreateInfo fence{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
    made = vk_.vkCreateFence(device_.handle(), &fence, nullptr, &fence_);
    if (made != VK_SUCCESS) return vulkanError("fence of the renderer", made);
    return {};
}

Result<void> OffscreenRenderer::createDescriptors() {
    const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 2};
    VkDescriptorPoolCreateInfo pool{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
    pool.maxSets = 1;
    pool.poolSizeCount = 1;
    pool.pPoolSizes = &size;
    VkResult made = vk_.vkCreateDescriptorPool(device_.handle(), &pool, nullptr, &descriptors_);
    if (made != VK_SUCCESS) return vulkanError("descriptor pool of the renderer", made);
    VkDescriptorSetAllocateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
    info.descriptorPool = descriptors_;
    info.descriptorSetCount = 1;
    const VkDescriptorSetLayout layout = pipelines_.setLayout();
    info.pSetLayouts = &layout;
    made = vk_.vkAllocateDescriptorSets(device_.handle(), &info, &set_);
    if (made != VK_SUCCESS) return vulkanError("descriptor set of the renderer", made);
    return {};
}

Result<void> OffscreenRenderer::check(const DrawScene& scene) const {
    const auto refuse = [](const char* what) { return Error{ErrorCode::Internal, std::string("cannot draw: ") + what}; };
    if (scene.draw_count == 0) return {};
    for (const BufferView& view : {scene.vertices, scene.indices, scene.draw_commands, scene.matrices}) {
        if (view.buffer == nullptr || view.size == 0) return refuse("a buffer of the scene is missing");
    }
    if ((scene.vertices.buffer->usage() & VK_BUFFER_USAGE_VERTEX_BUFFER_BIT) == 0)
        return refuse("vertices without vertex usage");
    if ((scene.indices.buffer->usage() & VK_BUFFER_USAGE_INDEX_BUFFER_BIT) == 0) return refuse("indices without index usage");
    if (scene.draw_commands.size < scene.draw_count * kCommandBytes) return refuse("fewer draw commands than draws");
    if (std::max(scene.matrices.size, scene.colors.size) > device_.limits().maxStorageBufferRange)
        return refuse("more matrices than a binding holds");
    return {};
}

Result<Picture> OffscreenRenderer::draw(const DrawScene& scene, const Camera& camera, const Look& look,
                                        std::span<const BufferView> released) {
    if (auto fine = check(scene); !fine) return fine.error();
    if (scene.draw_count > 0) bindObjects(scene);
    vk_.vkResetCommandPool(device_.handle(), pool_, 0);
    VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    VkResult result = vk_.vkBeginCommandBuffer(commands_, &begin);
    if (result != VK_SUCCESS) return vulkanError("recording a picture", result);
    Commands::acquireFromCompute(device_, commands_, released);
    recordScene(scene, pushOf(camera, look, scene.colors.buffer != nullptr));
    recordReadback();
    result = vk_.vkEndCommandBuffer(commands_);
    if (result != VK_SUCCESS) return vulkanError("recording a picture", result);
    vk_.vkResetFences(device_.handle(), 1, &fence_);
    if (auto submitted = device_.submit(device_.graphicsQueue(), commands_, fence_); !submitted) return submitted.error();
    result = vk_.vkWaitForFences(device_.handle(), 1, &fence_, VK_TRUE, UINT64_MAX);
    if (result != VK_SUCCESS) return vulkanError("waiting for a picture", result);
    return picture();
}

// What is not read still has to be something.
void OffscreenRenderer::bindObjects(const DrawScene& scene) {
    const BufferView& colors = scene.colors.buffer != nullptr ? scene.colors : scene.matrices;
    const VkDescriptorBufferInfo infos[] = {{scene.matrices.buffer->handle(), scene.matrices.offset, scene.matrices.size},
                                            {colors.buffer->handle(), colors.offset, colors.size}};
    VkWriteDescriptorSet write{VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
    write.dstSet = set_;
    write.descriptorCount = 2; // runs on into the next binding
    write.descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    write.pBufferInfo = infos;
    vk_.vkUpdateDescriptorSets(device_.handle(), 1, &write, 0, nullptr);
}

void OffscreenRenderer::recordScene(const DrawScene& scene, const gpu::DrawPush& push) {
    VkClearValue clears[2] = {};
    clears[1].depthStencil = {1.0f, 0};
    const VkRect2D area{{0, 0}, {color_.width(), color_.height()}};
    VkRenderPassBeginInfo begin{VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO};
    begin.renderPass = pipelines_.renderPass();
    begin.framebuffer = framebuffer_;
    begin.renderArea = area;
    begin.clearValueCount = 2;
    begin.pClearValues = clears;
    const VkViewport viewport{0, 0, static_cast<float>(color_.width()), static_cast<float>(color_.height()), 0, 1};
    vk_.vkCmdBeginRenderPass(commands_, &begin, VK_SUBPASS_CONTENTS_INLINE);
    vk_.vkCmdSetViewport(commands_, 0, 1, &viewport);
    vk_.vkCmdSetScissor(commands_, 0, 1, &area);
    vk_.vkCmdPushConstants(commands_, pipelines_.layout(), VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT, 0,
                           sizeof(push), &push);
    vk_.vkCmdBindPipeline(commands_, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines_.background());
    vk_.vkCmdDraw(commands_, 3, 1, 0, 0);
    if (scene.draw_count > 0) recordDraws(scene);
    vk_.vkCmdEndRenderPass(commands_);
}

void OffscreenRenderer::recordDraws(const DrawScene& scene) {
    vk_.vkCmdBindPipeline(commands_, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines_.fragments());
    vk_.vkCmdBindDescriptorSets(commands_, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines_.layout(), 0, 1, &set_, 0, nullptr);
    const VkBuffer vertices = scene.vertices.buffer->handle();
    vk_.vkCmdBindVertexBuffers(commands_, 0, 1, &vertices, &scene.vertices.offset);
    vk_.vkCmdBindIndexBuffer(commands_, scene.indices.buffer->handle(), scene.indices.offset, VK_INDEX_TYPE_UINT32);
    // One call where the device takes many draws a call; a call a draw where it takes only one.
    const uint32_t at_once = device_.features().multi_draw_indirect ? device_.limits().maxDrawIndirectCount : 1;
    for (uint32_t first = 0; first < scene.draw_count;) {
        const uint32_t count = std::min(at_once, scene.draw_count - first);
        vk_.vkCmdDrawIndexedIndirect(commands_, scene.draw_commands.buffer->handle(),
                                     scene.draw_commands.offset + first * kCommandBytes, count, kCommandBytes);
        first += count;
    }
}

void OffscreenRenderer::recordReadback() {
    const VkImageMemoryBarrier before = transition(resolved_.handle(), VK_IMAGE_LAYOUT_UNDEFINED,
                                                   VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 0, VK_ACCESS_TRANSFER_WRITE_BIT);
    vk_.vkCmdPipelineBarrier(commands_, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_TRANSFER_BIT, 0, 0, nullptr, 0,
                             nullptr, 1, &before);
    const VkImageSubresourceLayers layer{VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    const VkOffset3D large{static_cast<int32_t>(color_.width()), static_cast<int32_t>(color_.height()), 1};
    const VkOffset3D small{static_cast<int32_t>(width_), static_cast<int32_t>(height_), 1};
    const VkImageBlit blit{layer, {{0, 0, 0}, large}, layer, {{0, 0, 0}, small}};
    vk_.vkCmdBlitImage(commands_, color_.handle(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, resolved_.handle(),
                       VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &blit, VK_FILTER_LINEAR);
    const VkImageMemoryBarrier between =
        transition(resolved_.handle(), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                   VK_ACCESS_TRANSFER_WRITE_BIT, VK_ACCESS_TRANSFER_READ_BIT);
    vk_.vkCmdPipelineBarrier(commands_, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_TRANSFER_BIT, 0, 0, nullptr, 0,
                             nullptr, 1, &between);
    const VkBufferImageCopy copy{0, 0, 0, layer, {0, 0, 0}, {width_, height_, 1}};
    vk_.vkCmdCopyImageToBuffer(commands_, resolved_.handle(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, readback_.handle(), 1,
                               &copy);
    const VkMemoryBarrier after{VK_STRUCTURE_TYPE_MEMORY_BARRIER, nullptr, VK_ACCESS_TRANSFER_WRITE_BIT,
                                VK_ACCESS_HOST_READ_BIT};
    vk_.vkCmdPipelineBarrier(commands_, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &after, 0, nullptr, 0,
                             nullptr);
}

gpu::DrawPush OffscreenRenderer::pushOf(const Camera& camera, const Look& look, bool own_colors) const {
    gpu::DrawPush push{};
    push.view_projection = camera.viewProjection(static_cast<float>(width_) / static_cast<float>(height_));
    push.eye = {camera.eye[0], camera.eye[1], camera.eye[2], look.tint};
    const Vec3 light = keyLight(camera);
    push.key_direction = {light[0], light[1], light[2], look.light};
    push.outer_color = {look.outer_color[0], look.outer_color[1], look.outer_color[2], own_colors ? 1.0f : 0.0f};
    push.inner_color = {look.inner_color[0], look.inner_color[1], look.inner_color[2], 1};
    return push;
}

Picture OffscreenRenderer::picture() const {
    Picture result{width_, height_, std::vector<uint8_t>(readback_.size())};
    std::memcpy(result.pixels.data(), readback_.mapped(), readback_.size());
    return result;
}

} // namespace

Result<std::unique_ptr<Renderer>> Renderer::create(Device& device, uint32_t width, uint32_t height) {
    if (!device.hasGraphics()) return Error{ErrorCode::Device, device.name() + " has no graphics queue"};
    if (!device.features().draw_indirect_first_instance) {
        return Error{ErrorCode::Device, device.name() + " is opened without drawIndirectFirstInstance, which drawing needs"};
    }
    const uint32_t most = device.limits().maxImageDimension2D / kSupersample;
    if (width == 0 || height == 0 || width > most || height > most) {
        return Error{ErrorCode::BadInput, "a picture has 1 to " + std::to_string(most) + " pixels a side"};
    }
    auto renderer = std::make_unique<OffscreenRenderer>(device, width, height);
    if (auto made = renderer->createAll(); !made) return made.error();
    return std::unique_ptr<Renderer>(std::move(renderer));
}

} // namespace engine
