// What kernels take before and after they were reloaded.
#pragma once

#include "engine/timestamps.h"

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace engine {

struct KernelTimeChange {
    std::string name;
    double before_ms = 0, after_ms = 0; // of a frame, medians; before: 0 where it had not run yet
};

class KernelTimes {
public:
    // Medians are over so many frames, or before over as many as there were.
    explicit KernelTimes(size_t frames) : frames_(frames) {}

    // Of one frame, by kernel (Commands::timeKernels).
    void add(std::span<const Timing> timings);
    // From the next frame on these are other versions.
    void reloaded(std::span<const std::string> names);
    // Those that have run for long enough since; each is told once.
    std::vector<KernelTimeChange> takeChanges();

private:
    struct Kernel {
        std::vector<double> latest; // ms, oldest first
        std::vector<double> before;
        bool is_new = false;
    };
    size_t frames_;
    std::map<std::string, Kernel> kernels_;
};

} // namespace engine
