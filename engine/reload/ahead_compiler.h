// Has the driver compile a kernel before it is dispatched in earnest, where it would otherwise do so then.
#pragma once

#include "engine/kernel.h"

#include <string>
#include <thread>
#include <vector>

namespace engine {

using Specialization = std::vector<SpecConstant>;

// Under way from when it is made until it is destroyed, which waits for it. What goes wrong is left for those who dispatch.
class AheadCompilation {
public:
    // The specializations are compiled side by side (kernels_ahead.h).
    AheadCompilation(const Device& device, std::string name, KernelWords words, std::vector<Specialization> specializations);
    AheadCompilation(const AheadCompilation&) = delete;
    AheadCompilation& operator=(const AheadCompilation&) = delete;

private:
    std::jthread thread_;
};

} // namespace engine
