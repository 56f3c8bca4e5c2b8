#include "engine/reload/kernel_times.h"

#include <algorithm>

namespace engine {
namespace {

double medianOf(std::vector<double> values) {
    if (values.empty()) return 0;
    const auto middle = values.begin() + static_cast<ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
}

} // namespace

void KernelTimes::add(std::span<const Timing> timings) {
    for (const Timing& timing : timings) {
        std::vector<double>& latest = kernels_[timing.name].latest;
        if (latest.size() == frames_) latest.erase(latest.begin());
        latest.push_back(timing.ms);
    }
}

void KernelTimes::reloaded(std::span<const std::string> names) {
    for (const std::string& name : names) {
        Kernel& kernel = kernels_[name];
        if (!kernel.is_new) kernel.before = kernel.latest; // of two in a row: as it was before both
        kernel.latest.clear();
        kernel.is_new = true;
    }
}

std::vector<KernelTimeChange> KernelTimes::takeChanges() {
    std::vector<KernelTimeChange> changes;
    for (auto& [name, kernel] : kernels_) {
        if (!kernel.is_new || kernel.latest.size() < frames_) continue;
        changes.push_back({name, medianOf(kernel.before), medianOf(kernel.latest)});
        kernel.is_new = false;
    }
    return changes;
}

} // namespace engine
