// Gets kernels ready before they are met.
//
// A GPU's driver compiles a pipeline when it is created: many are created side by side. A CPU's driver (Mesa's) compiles at
// the first dispatch, one kernel after the other on the queue's own thread: there a second device of the same kind, on a
// thread of its own, dispatches nothing once for every kernel, and the driver's cache on disk carries the outcome over.
// Where the cache is off, that work is for nothing and the rest unharmed.
#pragma once

#include "engine/kernel.h"

#include <atomic>
#include <chrono>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace engine {

class KernelWarmup {
public:
    // `names` in the order in which to work on them: those first that the caller meets late and that take long. The library
    // and its device outlive the warm-up. Nothing is printed or returned: failures are left for those who ask for the kernel.
    KernelWarmup(Device& device, KernelLibrary& library, std::vector<std::string_view> names);
    // Of a CPU device it waits for the kernel that is being compiled, not for those that are left; of a GPU for all.
    ~KernelWarmup() = default;
    // Waits until all are ready.
    void finish();

private:
    std::jthread thread_;
};

// The same for recordings that are about to run for the first time. If they have not run after `patience`, a CPU's driver is at
// its first compilation, and other cores compile the library's kernels on twins, the last first, until stop(). On GPUs it does
// nothing.
class LateWarmup {
public:
    // The library and its device outlive it.
    LateWarmup(const Device& device, const KernelLibrary& library, std::chrono::milliseconds patience);
    // Returns at once. Kernels that are being compiled are finished, and the destructor waits for them.
    void stop();
    // Waits until all are compiled.
    void finish();

private:
    const Device& device_;
    const KernelLibrary& library_;
    std::vector<KernelRequest> requests_;
    std::atomic<size_t> taken_ = 0;
    std::jthread thread_; // which waits, and then has others beside it

    void work(const std::stop_token& stop, std::chrono::milliseconds patience);
    void compileNextOnes(const std::stop_token& stop);
};

} // namespace engine
