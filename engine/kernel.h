// Compute pipelines by name, made when first asked for, with everything about them read from their SPIR-V.
#pragma once

#include "engine/reflection.h"
#include "engine/vulkan.h"
#include "shaders-spirv/embedded.h"

#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace engine {

class Device;

// The most buffers that one kernel may bind; every device is asked for 16, those with more may use them.
constexpr uint32_t kMaxBindings = 32;

struct SpecConstant {
    uint32_t id = 0; // constant_id, or local_size_x_id
    uint32_t value = 0;
};

struct Kernel {
    std::string name;
    Reflection reflection; // local_size as it was specialized
    VkDescriptorSetLayout set_layout = VK_NULL_HANDLE;
    VkPipelineLayout layout = VK_NULL_HANDLE;
    VkPipeline pipeline = VK_NULL_HANDLE;

    std::vector<SpecConstant> constants; // that it was specialized with

    uint32_t bufferCount() const { return static_cast<uint32_t>(reflection.bindings.size()); }
};

struct KernelRequest {
    std::string_view name;
    std::vector<uint32_t> spec; // spec[i] sets constant_id i
};

class KernelLibrary {
public:
    // `common` holds for every kernel that declares a constant of that id: what all of them must agree on, such as the size
    // of their workgroups.
    explicit KernelLibrary(Device& device, std::span<const shaders::Module> modules = shaders::all(),
                           std::vector<SpecConstant> common = {});
    ~KernelLibrary();
    KernelLibrary(const KernelLibrary&) = delete;
    KernelLibrary& operator=(const KernelLibrary&) = delete;

    // Stays valid as long as the library. Safe from any thread.
    Result<const Kernel*> get(std::string_view name, std::span<const uint32_t> spec = {});
    Result<const Kernel*> get(std::string_view name, std::initializer_list<uint32_t> spec) {
        return get(name, std::span(spec.begin(), spec.size()));
    }
    // Makes many side by side, on all cores.
    Result<void> warm(std::span<const KernelRequest> requests);

    std::span<const shaders::Module> modules() const { return modules_; }
    const std::vector<SpecConstant>& common() const { return common_; }
    uint32_t kernelCount() const;
    std::vector<std::string> kernelNames() const; // of those made so far, in order, each once
    double creationMs() const; // in the driver, added up over all pipelines, also those made at the same time

private:
    using Key = std::pair<std::string, std::vector<uint32_t>>;
    Result<std::unique_ptr<Kernel>> make(std::string_view name, std::span<const uint32_t> spec);
    std::vector<SpecConstant> constantsOf(const Reflection& reflection, std::span<const uint32_t> spec) const;
    Result<void> makeLayouts(Kernel& kernel) const;
    Result<void> makePipeline(Kernel& kernel, std::span<const uint32_t> words, std::span<const SpecConstant> spec);
    void destroy(const Kernel& kernel) const;

    Device& device_;
    std::span<const shaders::Module> modules_;
    std::vector<SpecConstant> common_;
    mutable std::mutex mutex_;
    std::map<Key, std::unique_ptr<Kernel>> kernels_;
    double creation_ms_ = 0;
};

} // namespace engine
