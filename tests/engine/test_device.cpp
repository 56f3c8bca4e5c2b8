#include "tests/engine/test_device.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <gtest/gtest.h>
#include <memory>
#include <numeric>

namespace engine_test {

namespace {

template <class T>
T orExit(engine::Result<T> result) {
    if (result) return std::move(*result);
    std::fprintf(stderr, "%s\n", result.error().message.c_str());
    std::exit(EXIT_FAILURE);
}

// A device with the kernels made for it, which go before it.
struct TestDevice {
    explicit TestDevice(const engine::DeviceOptions& options)
        : device(orExit(engine::Device::create(options))), kernels(*device, shaders::engineTestKernels()) {}
    std::unique_ptr<engine::Device> device;
    engine::KernelLibrary kernels;
};

enum Kind { kFull, kPooled, kMinimal, kKinds };
std::array<std::unique_ptr<TestDevice>, kKinds> devices;
bool shares_pipelines = true; // each test makes a world of its own, and lavapipe takes a second for the kernels of one

engine::Device& deviceOf(Kind kind) {
    engine::DeviceOptions options;
    options.share_pipelines = shares_pipelines;
    options.force_pooled_descriptors = kind == kPooled;
    options.minimal = kind == kMinimal;
    if (!devices[kind]) devices[kind] = std::make_unique<TestDevice>(options);
    return *devices[kind]->device;
}

bool environmentHas(const char* variable, const char* part) {
    const char* value = std::getenv(variable);
    return value != nullptr && std::strstr(value, part) != nullptr;
}

// The loader leaves out layers that are asked for and not installed.
bool isInstalled(const char* layer) {
    const auto list = reinterpret_cast<PFN_vkEnumerateInstanceLayerProperties>(
        engine::loaderFunction()(nullptr, "vkEnumerateInstanceLayerProperties"));
    uint32_t count = 0;
    list(&count, nullptr);
    std::vector<VkLayerProperties> layers(count);
    list(&count, layers.data());
    return std::ranges::any_of(layers, [&](const auto& l) { return std::strcmp(l.layerName, layer) == 0; });
}

} // namespace

engine::Device& device() { return deviceOf(kFull); }
engine::Device& pooledDevice() { return deviceOf(kPooled); }
engine::Device& minimalDevice() { return deviceOf(kMinimal); }
std::vector<engine::Device*> allDevices() { return {&device(), &pooledDevice(), &minimalDevice()}; }

void keepPipelinesApart() { shares_pipelines = false; }

void destroyDevices() {
    for (auto& made : devices)
        made.reset();
}

const engine::Kernel& testKernel(engine::Device& device, std::string_view name, std::initializer_list<uint32_t> spec) {
    const auto owner = std::ranges::find_if(devices, [&](const auto& d) { return d && d->device.get() == &device; });
    ENGINE_ASSERT(owner != devices.end());
    return *orExit((*owner)->kernels.get(name, spec));
}

engine::Buffer upload(engine::Device& device, const std::vector<uint32_t>& words) {
    auto buffer = orExit(engine::Buffer::create(device, words.size() * 4, engine::BufferDomain::Upload, 0, "upload"));
    std::memcpy(buffer.mapped(), words.data(), words.size() * 4);
    return buffer;
}

engine::Buffer scratch(engine::Device& device, size_t words) {
    return orExit(engine::Buffer::create(device, words * 4, engine::BufferDomain::Device, 0, "scratch"));
}

engine::Buffer readback(engine::Device& device, size_t words) {
    auto buffer = orExit(engine::Buffer::create(device, words * 4, engine::BufferDomain::Readback, 0, "readback"));
    std::memset(buffer.mapped(), 0xcd, words * 4);
    return buffer;
}

std::vector<uint32_t> wordsOf(const engine::Buffer& buffer) {
    const uint32_t* words = buffer.mappedAs<uint32_t>();
    return {words, words + buffer.size() / 4};
}

std::vector<uint32_t> countingFrom(uint32_t first, size_t count) {
    std::vector<uint32_t> words(count);
    std::iota(words.begin(), words.end(), first);
    return words;
}

void finish(engine::Commands& commands) {
    const auto done = commands.submitAndWait();
    if (!done) ADD_FAILURE() << done.error().message;
}

bool validationIsOn() { return environmentHas("VK_INSTANCE_LAYERS", "VK_LAYER_KHRONOS_validation"); }

bool synchronizationValidationIsWanted() {
    return validationIsOn() && environmentHas("VK_LAYER_ENABLES", "ENABLE_SYNCHRONIZATION_VALIDATION_EXT");
}

bool synchronizationValidationIsOn() {
    return synchronizationValidationIsWanted() && isInstalled("VK_LAYER_KHRONOS_validation");
}

} // namespace engine_test
