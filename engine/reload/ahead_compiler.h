// Has the driver compile a kernel before it is dispatched in earnest, where it would otherwise do so then (kernel_twin.h).
#pragma once

#include "engine/kernel_twin.h"

#include <atomic>
#include <string>
#include <thread>
#include <vector>

namespace engine {

using Specialization = std::vector<SpecConstant>;

// Under way from when it is made until it is destroyed, which waits for it. What goes wrong is left for those who dispatch.
class AheadCompilation {
public:
    // The specializations are compiled side by side, each core with a twin of its own. Twins are not kept: the driver writes
    // its cache behind one's back, and is done with it for certain only when the device is gone.
    AheadCompilation(const Device& device, std::string name, KernelWords words, std::vector<Specialization> specializations);
    AheadCompilation(const AheadCompilation&) = delete;
    AheadCompilation& operator=(const AheadCompilation&) = delete;

private:
    void work();

    const Device& device_;
    std::string name_;
    KernelWords words_;
    std::vector<Specialization> specializations_;
    std::atomic<size_t> next_ = 0;
    std::vector<std::jthread> threads_; // last, so that they end before what they look at
};

} // namespace engine
