// Whether the source of a kernel is fit to take the place of the kernel that a host was built with.
#pragma once

#include "engine/kernel.h"
#include "engine/reload/glsl_compiler.h"

#include <functional>
#include <set>

namespace engine {

struct CheckedKernel {
    KernelWords words; // none where it is not fit
    std::vector<Diagnostic> diagnostics;
    std::set<std::filesystem::path> files; // as CompiledKernel has them
    bool knows_files = true;               // false: there may be more of them
    double ms = 0;                         // that it took
    bool good() const { return words != nullptr; }
};

// How much a kernel may keep beside its buffers (kernel_storage.h). Shared memory is the device's; most have no less than this.
// What a lane keeps no specification limits: drivers put it on the stack of a thread, several lanes at a time.
struct StorageLimits {
    uint64_t shared_bytes = 32768, lane_bytes = 65536;
};

// A row of a table as it lies in a folder.
KernelSource sourceOf(const shaders::Module& module, const std::filesystem::path& folder);

// Compiles and validates it, looks at what it keeps, and compares its interface with the host's; `host` may be nullptr, for a
// kernel that none was built with.
CheckedKernel checkKernel(const KernelSource& source, const shaders::Module* host,
                          const std::vector<std::filesystem::path>& include_folders, const StorageLimits& limits = {});

// What there is to check in a folder: the rows of `modules`, and by their own names the kernels that no row names. Rows count
// where the folder has the file of at least one of them; else it is a folder of somebody else.
struct FolderKernel {
    KernelSource source;
    const shaders::Module* host = nullptr;
};
std::vector<FolderKernel> kernelsIn(const std::filesystem::path& folder, std::span<const shaders::Module> modules);

// All of them side by side, in processes of their own (checking_process.h). `done` is called as each is, one at a time, from
// any thread; results are in the order of `kernels`.
std::vector<CheckedKernel> checkKernels(const std::vector<FolderKernel>& kernels,
                                        const std::vector<std::filesystem::path>& include_folders,
                                        const std::function<void(size_t done)>& progress = {});

} // namespace engine
