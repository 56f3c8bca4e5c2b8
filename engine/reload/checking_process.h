// Checks kernels in a process of its own. The compiler is glslang, which was not made for hostile sources: an expression of
// some ten thousand terms overflows its stack, and macros that double in every line keep it busy for ever and eat all memory.
// None of that may reach the program that runs the kernels.
#pragma once

#include "engine/isolated.h"
#include "engine/reload/kernel_check.h"

namespace engine {

class CheckingProcess {
public:
    explicit CheckingProcess(const StorageLimits& limits = {});

    // As checkKernel, for whatever there may be in the source: what the compiler does not survive, or what takes it longer than
    // 30 s or more than 2 GiB, is a diagnostic. `host` has to have been there when this was first called. `is_unwanted` is
    // asked every few milliseconds; once it says so, nothing comes of it and the result is not to be used. From one thread.
    CheckedKernel check(const KernelSource& source, const shaders::Module* host,
                        const std::vector<std::filesystem::path>& include_folders,
                        const std::function<bool()>& is_unwanted = {});

private:
    IsolatedProcess process_;
};

} // namespace engine
