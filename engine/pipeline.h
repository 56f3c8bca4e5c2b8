// Compute pipelines with the layouts that they were made with, and those that all libraries of a device have in common.
#pragma once

#include "engine/result.h"
#include "engine/vulkan.h"

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

namespace engine {

class Device;

struct SpecConstant {
    uint32_t id = 0; // constant_id, or local_size_x_id
    uint32_t value = 0;
    auto operator<=>(const SpecConstant&) const = default;
};

struct PipelineSource {
    std::string name; // for messages and captures
    std::span<const uint32_t> words;
    std::span<const SpecConstant> constants;
    uint32_t buffer_count = 0;
    uint32_t push_size = 0;
};

// Shared by the kernel and every recording that uses it: one that was replaced lives until the last of these is gone.
class Pipeline {
public:
    // Errors: Device.
    static Result<std::shared_ptr<const Pipeline>> create(Device& device, const PipelineSource& source);
    ~Pipeline();
    Pipeline(const Pipeline&) = delete;
    Pipeline& operator=(const Pipeline&) = delete;
    VkPipeline handle() const { return handle_; }
    VkDescriptorSetLayout setLayout() const { return set_layout_; }
    VkPipelineLayout layout() const { return layout_; }

private:
    explicit Pipeline(Device& device) : device_(device) {}
    Result<void> makeLayouts(const PipelineSource& source);
    Result<void> make(const PipelineSource& source);

    Device& device_;
    VkDescriptorSetLayout set_layout_ = VK_NULL_HANDLE;
    VkPipelineLayout layout_ = VK_NULL_HANDLE;
    VkPipeline handle_ = VK_NULL_HANDLE;
};

// By code and constants, each made once and kept as long as this. Safe from any thread.
class SharedPipelines {
public:
    using Make = std::function<Result<std::shared_ptr<const Pipeline>>()>;
    // Of several threads with the same wish that nobody had before, all but one throw away what they made.
    Result<std::shared_ptr<const Pipeline>> get(const PipelineSource& source, const Make& make);
    bool has(std::span<const uint32_t> words, std::span<const SpecConstant> constants) const;

private:
    using Key = std::pair<std::vector<uint32_t>, std::vector<SpecConstant>>;

    static Key keyOf(std::span<const uint32_t> words, std::span<const SpecConstant> constants);

    mutable std::mutex mutex_;
    std::map<Key, std::shared_ptr<const Pipeline>> pipelines_;
};

} // namespace engine
