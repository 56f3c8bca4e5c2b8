// Devices that the tests of one program share, and small ways to move words in and out.
#pragma once

#include "engine/commands.h"
#include "engine/device.h"

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace shaders {
std::span<const Module> engineTestKernels();
}

namespace engine_test {

// Made on first use; ends the program with a message where there is no Vulkan device.
engine::Device& device();        // all that this machine's device offers
engine::Device& pooledDevice();  // as if it had no push descriptors
engine::Device& minimalDevice(); // nothing optional
std::vector<engine::Device*> allDevices();
void destroyDevices();
// All kernel libraries of these devices share pipelines, unless a program calls this before it asks for a device.
void keepPipelinesApart();

// From the kernels of the engine's tests; ends the program where it cannot be made.
const engine::Kernel& testKernel(engine::Device& device, std::string_view name, std::initializer_list<uint32_t> spec = {});

engine::Buffer upload(engine::Device& device, const std::vector<uint32_t>& words);
engine::Buffer scratch(engine::Device& device, size_t words);
engine::Buffer readback(engine::Device& device, size_t words); // filled with 0xcd
std::vector<uint32_t> wordsOf(const engine::Buffer& buffer);
std::vector<uint32_t> countingFrom(uint32_t first, size_t count);

// Submits, waits, and fails the running test with the message where that goes wrong.
void finish(engine::Commands& commands);
// Each of the first two returns whether the environment asks for this validation; the third, whether the layer is installed,
// too.
bool validationIsOn();
bool synchronizationValidationIsWanted();
bool synchronizationValidationIsOn();
// Sets how many messages of the layer the running test means to cause.
void expectValidationMessages(uint32_t count);

} // namespace engine_test
