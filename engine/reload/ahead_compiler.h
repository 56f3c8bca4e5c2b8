// Has the driver compile kernels before they are dispatched in earnest, where it would otherwise do so then (kernel_twin.h).
#pragma once

#include "engine/kernel_twin.h"

#include <span>

namespace engine {

class AheadCompiler {
public:
    // For work on a thread of one's own; opens no device before there is something to compile.
    explicit AheadCompiler(const Device& device) : device_(device), helps_(KernelTwin::helps(device)) {}
    // In each of these specializations. What goes wrong is left for those who dispatch it.
    void compile(const std::string& name, const KernelWords& words, std::span<const std::vector<SpecConstant>> specializations);

private:
    const Device& device_;
    bool helps_;
    std::unique_ptr<KernelTwin> twin_;
};

} // namespace engine
