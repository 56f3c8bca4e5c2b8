#include "engine/kernels_ahead.h"

#include "engine/kernel_twin.h"

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <thread>

namespace engine {
namespace {

// As Mesa reads it.
bool cacheIsOff() {
    const char* off = std::getenv("MESA_SHADER_CACHE_DISABLE");
    return off != nullptr && (std::string_view(off) == "true" || std::string_view(off) == "1");
}

class Compilation {
public:
    Compilation(const Device& device, std::span<const shaders::Module> modules, std::span<const KernelAhead> kernels)
        : device_(device), modules_(modules), kernels_(kernels) {}

    // On as many threads as one likes. What is thrown on a thread ends the process, and nothing here is worth that.
    void work(const std::function<void(size_t)>& show) {
        try {
            compileNextOnes(show);
        } catch (...) {
        }
    }

private:
    void compileNextOnes(const std::function<void(size_t)>& show) {
        const auto twin = KernelTwin::create(device_);
        if (!twin) return;
        for (size_t k = next_++; k < kernels_.size(); k = next_++) {
            if (show) show(k);
            KernelLibrary library((*twin)->device(), modules_, kernels_[k].constants);
            (*twin)->compile(library, kernels_[k].name);
        }
    }

    const Device& device_;
    std::span<const shaders::Module> modules_;
    std::span<const KernelAhead> kernels_;
    std::atomic<size_t> next_ = 0;
};

} // namespace

void compileAhead(const Device& device, std::span<const shaders::Module> modules, std::span<const KernelAhead> kernels,
                  const std::function<void(size_t)>& show) {
    if (!KernelTwin::helps(device) || cacheIsOff()) return;
    Compilation compilation(device, modules, kernels);
    std::vector<std::jthread> threads;
    const size_t cores = std::max(1u, std::thread::hardware_concurrency());
    for (size_t k = 1; k < std::min(cores, kernels.size()); ++k)
        threads.emplace_back([&compilation] { compilation.work({}); });
    compilation.work(show);
}

} // namespace engine
