#include "engine/image.h"

#include "engine/device.h"

#include <utility>

namespace engine {

Result<Image> Image::create(Device& device, uint32_t width, uint32_t height, VkFormat format, VkImageUsageFlags usage,
                            std::string_view name) {
    Image image;
    image.device_ = &device;
    image.format_ = format;
    image.width_ = width;
    image.height_ = height;
    VkImageCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = format;
    info.extent = {width, height, 1};
    info.mipLevels = 1;
    info.arrayLayers = 1;
    info.samples = VK_SAMPLE_COUNT_1_BIT;
    info.tiling = VK_IMAGE_TILING_OPTIMAL;
    info.usage = usage;
    const VolkDeviceTable& vk = device.vk();
    VkResult made = vk.vkCreateImage(device.handle(), &info, nullptr, &image.handle_);
    if (made != VK_SUCCESS) return vulkanError("image \"" + std::string(name) + "\"", made);

    VkMemoryRequirements needs;
    vk.vkGetImageMemoryRequirements(device.handle(), image.handle_, &needs);
    const auto type = device.memory().pickType(needs.memoryTypeBits, 0, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
    if (!type) return type.error();
    const VkMemoryAllocateInfo memory{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, nullptr, needs.size, *type};
    made = vk.vkAllocateMemory(device.handle(), &memory, nullptr, &image.memory_);
    if (made == VK_SUCCESS) made = vk.vkBindImageMemory(device.handle(), image.handle_, image.memory_, 0);
    if (made != VK_SUCCESS) return vulkanError("memory of image \"" + std::string(name) + "\"", made);
    device.setName(VK_OBJECT_TYPE_IMAGE, reinterpret_cast<uint64_t>(image.handle_), name);
    if (auto view = image.createView(usage); !view) return view.error();
    return image;
}

Result<void> Image::createView(VkImageUsageFlags usage) {
    const bool depth = (usage & VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT) != 0;
    if (!depth && (usage & VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT) == 0) return {};
    VkImageViewCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
    info.image = handle_;
    info.viewType = VK_IMAGE_VIEW_TYPE_2D;
    info.format = format_;
    const VkImageAspectFlags aspect = depth ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
    info.subresourceRange = {aspect, 0, 1, 0, 1};
    const VkResult made = device_->vk().vkCreateImageView(device_->handle(), &info, nullptr, &view_);
    if (made != VK_SUCCESS) return vulkanError("image view", made);
    return {};
}

void Image::destroy() {
    if (device_ == nullptr) return;
    const VolkDeviceTable& vk = device_->vk();
    vk.vkDestroyImageView(device_->handle(), view_, nullptr);
    vk.vkDestroyImage(device_->handle(), handle_, nullptr);
    vk.vkFreeMemory(device_->handle(), memory_, nullptr);
}

void Image::swap(Image& other) noexcept {
    std::swap(device_, other.device_);
    std::swap(handle_, other.handle_);
    std::swap(view_, other.view_);
    std::swap(format_, other.format_);
    std::swap(width_, other.width_);
    std::swap(height_, other.height_);
    std::swap(memory_, other.memory_);
}

} // namespace engine
