#include "engine/kernel.h"

#include "engine/device.h"
#include "engine/kernel_storage.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <optional>
#include <thread>

namespace engine {

namespace {

Error refused(std::string_view kernel, const std::string& why) {
    return {ErrorCode::Internal, "kernel \"" + std::string(kernel) + "\": " + why};
}

// A kernel's buffers are the bindings 0, 1, 2, ... of set 0, so that a dispatch can list them in order.
Result<void> checkInterface(const Kernel& kernel, const VkPhysicalDeviceLimits& limits) {
    const Reflection& r = kernel.reflection;
    if (r.stage != ShaderStage::Compute) return refused(kernel.name, "is not a compute shader");
    for (uint32_t i = 0; i < r.bindings.size(); ++i) {
        const ReflectedBinding& b = r.bindings[i];
        if (!b.storage_buffer) return refused(kernel.name, "binds \"" + b.name + "\", which is no storage buffer");
        if (b.set != 0 || b.binding != i) {
            return refused(kernel.name, "binding " + std::to_string(i) + " of set 0 is missing or there twice");
        }
    }
    const uint32_t most = std::min(kMaxBindings, limits.maxPerStageDescriptorStorageBuffers);
    if (r.bindings.size() > most) {
        return refused(kernel.name,
                       "binds " + std::to_string(r.bindings.size()) + " buffers, the device has " + std::to_string(most));
    }
    if (r.push_size > limits.maxPushConstantsSize) return refused(kernel.name, "has too many push constants");
    if (r.local_size[1] != 1 || r.local_size[2] != 1) return refused(kernel.name, "has a workgroup of more than one dimension");
    const uint32_t most_lanes = std::min(limits.maxComputeWorkGroupInvocations, limits.maxComputeWorkGroupSize[0]);
    if (r.local_size[0] == 0 || r.local_size[0] > most_lanes)
        return refused(kernel.name, "has a workgroup of " + std::to_string(r.local_size[0]) + " lanes, the device takes 1 to " +
                                        std::to_string(most_lanes));
    return {};
}

Result<void> checkCapabilities(const Kernel& kernel, const Device& device) {
    const std::string lacking = lackingCapability(kernel.reflection.capabilities, device.features());
    if (lacking.empty()) return {};
    return Error{ErrorCode::Feature, refused(kernel.name, "needs " + lacking + ", which " + device.name() + " lacks").message};
}

Result<void> checkStorage(std::string_view kernel, std::span<const uint32_t> words, std::span<const SpecConstant> constants,
                          const VkPhysicalDeviceLimits& limits) {
    const uint64_t shared = storageOf(words, constants).shared.bytes;
    if (shared <= limits.maxComputeSharedMemorySize) return {};
    return Error{ErrorCode::Feature, refused(kernel, "shares " + std::to_string(shared) + " bytes in a group, the device has " +
                                                         std::to_string(limits.maxComputeSharedMemorySize))
                                         .message};
}

// What is thrown on a thread ends the process.
template <class Make>
Result<const Kernel*> tryTo(Make&& make) {
    try {
        return make();
    } catch (const std::exception& thrown) {
        return Error{ErrorCode::Internal, std::string("making a kernel: ") + thrown.what()};
    }
}

void specializeLocalSize(Reflection& reflection, std::span<const SpecConstant> constants) {
    for (size_t k = 0; k < 3; ++k) {
        for (const SpecConstant& constant : constants)
            if (reflection.local_size_ids[k] == constant.id) reflection.local_size[k] = constant.value;
    }
}

} // namespace

KernelLibrary::KernelLibrary(Device& device, std::span<const shaders::Module> modules, std::vector<SpecConstant> common)
    : device_(device), modules_(modules), common_(std::move(common)) {}

KernelLibrary::~KernelLibrary() { device_.waitIdle(); }

Result<const Kernel*> KernelLibrary::get(std::string_view name, std::span<const uint32_t> spec) {
    Key key{std::string(name), {spec.begin(), spec.end()}};
    {
        const std::lock_guard lock(mutex_);
        if (const auto found = kernels_.find(key); found != kernels_.end()) return found->second.get();
    }
    for (;;) {
        const auto code = codeOf(name);
        if (!code) return code.error();
        // Made outside the lock, so that several can be made at a time; of two threads with the same wish one throws its away.
        auto made = make(name, spec, *code);
        if (!made) return made.error();
        const std::lock_guard lock(mutex_);
        const bool replaced_meanwhile = latestCode(name).words.data() != code->words.data();
        if (!replaced_meanwhile) {
            const auto [place, is_new] = kernels_.try_emplace(key, std::move(*made));
            if (is_new) order_.push_back(&place->first);
            return place->second.get();
        }
        if (const auto place = kernels_.find(key); place != kernels_.end()) return place->second.get();
    }
}

Result<void> KernelLibrary::warm(std::span<const KernelRequest> requests) {
    std::atomic<size_t> next = 0;
    std::mutex failure_mutex;
    std::optional<Error> failure;
    const auto work = [&] {
        for (size_t i = next++; i < requests.size(); i = next++) {
            auto made = tryTo([&] { return get(requests[i].name, requests[i].spec); });
            if (made) continue;
            const std::lock_guard lock(failure_mutex);
            if (!failure) failure = made.error();
        }
    };
    {
        const size_t cores = std::max(1u, std::thread::hardware_concurrency());
        std::vector<std::jthread> threads;
        for (size_t i = 1; i < std::min(cores, requests.size()); ++i)
            threads.emplace_back(work);
        work();
    }
    if (failure) return *failure;
    return {};
}

bool KernelLibrary::isShared(std::string_view name) const {
    const SharedPipelines* shared = device_.sharedPipelines();
    if (shared == nullptr) return false;
    const auto code = codeOf(name);
    if (!code) return false;
    const auto reflection = reflect(code->words);
    return reflection && shared->has(code->words, constantsOf(*reflection, {}));
}

const OptionalFeatures& KernelLibrary::deviceFeatures() const { return device_.features(); }

uint32_t KernelLibrary::kernelCount() const {
    const std::lock_guard lock(mutex_);
    return static_cast<uint32_t>(kernels_.size());
}

std::vector<std::string> KernelLibrary::kernelNames() const {
    const std::lock_guard lock(mutex_);
    std::vector<std::string> names;
    for (const auto& [key, kernel] : kernels_)
        if (names.empty() || names.back() != key.first) names.push_back(key.first);
    return names;
}

std::vector<KernelRequest> KernelLibrary::requests() const {
    const std::lock_guard lock(mutex_);
    std::vector<KernelRequest> requests;
    for (const Key* key : order_)
        requests.push_back({key->first, key->second});
    return requests;
}

double KernelLibrary::creationMs() const {
    const std::lock_guard lock(mutex_);
    return creation_ms_;
}

Result<std::unique_ptr<Kernel>> KernelLibrary::make(std::string_view name, std::span<const uint32_t> spec, const Code& code) {
    auto reflection = reflect(code.words);
    if (!reflection) return refused(name, reflection.error().message);
    auto kernel = std::make_unique<Kernel>();
    kernel->name = name;
    kernel->reflection = std::move(*reflection);
    const std::vector<SpecConstant> constants = constantsOf(kernel->reflection, spec);
    specializeLocalSize(kernel->reflection, constants);
    kernel->constants = constants;
    if (auto fit = checkInterface(*kernel, device_.limits()); !fit) return fit.error();
    if (auto able = checkCapabilities(*kernel, device_); !able) return able.error();
    auto pipeline = makePipeline(*kernel, code.words);
    if (!pipeline) return pipeline.error();
    kernel->pipeline = std::move(*pipeline);
    return kernel;
}

KernelLibrary::Code KernelLibrary::latestCode(std::string_view name) const {
    if (const auto replaced = replaced_.find(name); replaced != replaced_.end()) return {*replaced->second, replaced->second};
    const auto module = std::ranges::find(modules_, name, &shaders::Module::name);
    return module == modules_.end() ? Code{} : Code{module->words, nullptr};
}

Result<KernelLibrary::Code> KernelLibrary::codeOf(std::string_view name) const {
    const std::lock_guard lock(mutex_);
    Code code = latestCode(name);
    if (code.words.empty()) return Error{ErrorCode::Internal, "no kernel is named \"" + std::string(name) + "\""};
    return code;
}

// Those asked for by place, and those in common that the kernel declares and that were not asked for.
std::vector<SpecConstant> KernelLibrary::constantsOf(const Reflection& reflection, std::span<const uint32_t> spec) const {
    std::vector<SpecConstant> constants;
    for (uint32_t i = 0; i < spec.size(); ++i)
        constants.push_back({i, spec[i]});
    for (const SpecConstant& constant : common_) {
        if (constant.id >= spec.size() && std::ranges::binary_search(reflection.spec_ids, constant.id))
            constants.push_back(constant);
    }
    return constants;
}

Result<std::shared_ptr<const Pipeline>> KernelLibrary::makePipeline(const Kernel& kernel, std::span<const uint32_t> words) {
    if (auto fits = checkStorage(kernel.name, words, kernel.constants, device_.limits()); !fits) return fits.error();
    const PipelineSource source{kernel.name, words, kernel.constants, kernel.bufferCount(), kernel.reflection.push_size};
    const auto make = [&] {
        const auto start = std::chrono::steady_clock::now();
        auto pipeline = Pipeline::create(device_, source);
        const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
        const std::lock_guard lock(mutex_);
        creation_ms_ += took.count();
        return pipeline;
    };
    SharedPipelines* shared = device_.sharedPipelines();
    return shared != nullptr ? shared->get(source, make) : make();
}

} // namespace engine
