#include "engine/kernel_warmup.h"

#include "engine/device.h"
#include "engine/kernel_twin.h"

#include <algorithm>
#include <condition_variable>
#include <mutex>

namespace engine {
namespace {

// What libraries share somebody else has asked for, and compiles.
void compileOnTwin(const std::stop_token& stop, const Device& device, const KernelLibrary& of,
                   std::vector<std::string_view> kernels) {
    std::erase_if(kernels, [&](std::string_view kernel) { return of.isShared(kernel); });
    if (kernels.empty()) return;
    auto twin = KernelTwin::create(device);
    if (!twin) return;
    KernelLibrary library((*twin)->device(), of.modules(), of.common());
    for (const std::string_view kernel : kernels) {
        if (stop.stop_requested()) return;
        (*twin)->compile(library, kernel);
    }
}

// What a thread throws ends the process, and nothing here is worth that: whoever asks for the kernel finds out.
template <class Work>
void quietly(Work&& work) {
    try {
        work();
    } catch (...) {
    }
}

} // namespace

KernelWarmup::KernelWarmup(Device& device, KernelLibrary& library, std::vector<std::string_view> names) {
    if (device.isCpu() && !KernelTwin::helps(device)) return;
    if (device.gpuAssistedValidation()) return; // as there
    if (device.isCpu()) {
        thread_ = std::jthread([&device, &library, names = std::move(names)](const std::stop_token& stop) mutable {
            quietly([&] { compileOnTwin(stop, device, library, std::move(names)); });
        });
        return;
    }
    thread_ = std::jthread([&library, names = std::move(names)] {
        std::vector<KernelRequest> requests;
        for (const std::string_view name : names)
            requests.push_back({name, {}});
        quietly([&] { static_cast<void>(library.warm(requests)); });
    });
}

void KernelWarmup::finish() {
    if (thread_.joinable()) thread_.join();
}

LateWarmup::LateWarmup(const Device& device, const KernelLibrary& library, std::chrono::milliseconds patience)
    : device_(device), library_(library) {
    if (!KernelTwin::helps(device)) return;
    if (std::thread::hardware_concurrency() < 2) return;
    requests_ = library.requests();
    thread_ = std::jthread([this, patience](const std::stop_token& stop) { quietly([&] { work(stop, patience); }); });
}

void LateWarmup::stop() { thread_.request_stop(); }

void LateWarmup::finish() {
    if (thread_.joinable()) thread_.join();
}

void LateWarmup::work(const std::stop_token& stop, std::chrono::milliseconds patience) {
    std::mutex mutex;
    std::condition_variable_any never;
    std::unique_lock lock(mutex);
    never.wait_for(lock, stop, patience, [] { return false; });
    if (stop.stop_requested()) return;
    constexpr unsigned kMostThreads = 4; // beside the driver's own
    std::vector<std::jthread> others;
    for (unsigned k = 1; k < std::min(std::thread::hardware_concurrency() - 1, kMostThreads); ++k)
        others.emplace_back([&] { quietly([&] { compileNextOnes(stop); }); });
    compileNextOnes(stop);
}

void LateWarmup::compileNextOnes(const std::stop_token& stop) {
    const auto twin = KernelTwin::create(device_);
    if (!twin) return;
    KernelLibrary library((*twin)->device(), library_.modules(), library_.common());
    for (size_t k = taken_++; k < requests_.size() && !stop.stop_requested(); k = taken_++) {
        const KernelRequest& request = requests_[requests_.size() - 1 - k];
        (*twin)->compile(library, request.name, request.spec);
    }
}

} // namespace engine
