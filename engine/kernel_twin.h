// A second device of the same kind, on which kernels are compiled that the first one is about to run.
//
// A CPU's driver (Mesa's) compiles a kernel when it is first dispatched, on the queue's own thread: whoever dispatches it
// waits. Dispatching nothing on the twin compiles it beforehand, and the driver's cache on disk carries the outcome over.
#pragma once

#include "engine/buffer.h"
#include "engine/device.h"
#include "engine/kernel.h"

#include <memory>
#include <string_view>

namespace engine {

class KernelTwin {
public:
    // Whether that is of any use for a device: it has to be a CPU's and one of ours, since a host has not asked for a second
    // device in its process; under GPU-assisted validation the layer's own work on every kernel would be done twice.
    static bool helps(const Device& device);
    static Result<std::unique_ptr<KernelTwin>> create(const Device& of);

    Device& device() { return *device_; } // to make libraries on
    // One of such a library, in this specialization. Failures are left for those who ask for the kernel in earnest.
    void compile(KernelLibrary& library, std::string_view name, std::span<const uint32_t> spec = {});

private:
    KernelTwin(std::unique_ptr<Device> device, Buffer buffer) : device_(std::move(device)), buffer_(std::move(buffer)) {}

    std::unique_ptr<Device> device_;
    Buffer buffer_;
};

} // namespace engine
