// An image on the device, for drawing off screen.
#pragma once

#include "engine/memory.h"

#include <string_view>

namespace engine {

class Image {
public:
    static Result<Image> create(Device& device, uint32_t width, uint32_t height, VkFormat format, VkImageUsageFlags usage,
                                std::string_view name);
    Image() = default;
    ~Image() { destroy(); }
    Image(Image&& other) noexcept { swap(other); }
    Image& operator=(Image&& other) noexcept {
        Image moved(std::move(other));
        swap(moved);
        return *this;
    }

    VkImage handle() const { return handle_; }
    VkImageView view() const { return view_; } // only of attachments
    VkFormat format() const { return format_; }
    uint32_t width() const { return width_; }
    uint32_t height() const { return height_; }

private:
    Result<void> createView(VkImageUsageFlags usage);
    void destroy();
    void swap(Image& other) noexcept;

    Device* device_ = nullptr;
    VkImage handle_ = VK_NULL_HANDLE;
    VkImageView view_ = VK_NULL_HANDLE;
    VkFormat format_ = VK_FORMAT_UNDEFINED;
    uint32_t width_ = 0, height_ = 0;
    VkDeviceMemory memory_ = VK_NULL_HANDLE; // of its own: images are few and must not lie beside buffers
};

} // namespace engine
