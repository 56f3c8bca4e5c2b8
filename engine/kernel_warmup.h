// Gets kernels ready before they are met.
//
// A GPU's driver compiles a pipeline when it is created: many are created side by side. A CPU's driver (Mesa's) compiles at
// the first dispatch, one kernel after the other on the queue's own thread: there a second device of the same kind, on a
// thread of its own, dispatches nothing once for every kernel, and the driver's cache on disk carries the outcome over.
// Where the cache is off, that work is for nothing and the rest unharmed.
#pragma once

#include "engine/kernel.h"

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

} // namespace engine
