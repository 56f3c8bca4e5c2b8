// Has a CPU's driver compile many kernels side by side before any of them is met.
//
// It would compile each at its first dispatch, one after the other on the queue's own thread (kernel_twin.h), while all other
// cores wait. Here every core gets a second device; the driver's cache on disk carries the outcome over. The
// devices are not kept: the driver writes its cache behind one's back, and is done with it for certain only when they are gone.
#pragma once

#include "engine/kernel.h"

#include <functional>
#include <span>
#include <string_view>
#include <vector>

namespace engine {

struct KernelAhead {
    std::string_view name;
    std::vector<SpecConstant> constants; // those that the kernel does not declare are left out
};

// Waits for the last of them. `show` is told how many have been begun, by the calling thread now and then. Does nothing where
// it would be for nothing: on GPUs, whose drivers compile when pipelines are made, and where the cache is turned off.
// Failures are left for those who ask for the kernel in earnest.
void compileAhead(const Device& device, std::span<const shaders::Module> modules, std::span<const KernelAhead> kernels,
                  const std::function<void(size_t)>& show);

} // namespace engine
