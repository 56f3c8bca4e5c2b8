// A kernel that follows its source, and a version of it on its way there.
#pragma once

#include "engine/reload/edits.h"
#include "engine/reload/kernel_check.h"

#include <algorithm>
#include <set>

namespace engine {

// Where a replacement is to go.
struct LibraryReplacement {
    KernelLibrary* library = nullptr;
    KernelReplacement replacement;
};

struct FollowedKernel {
    KernelSource source;
    const shaders::Module* host = nullptr;
    std::set<std::filesystem::path> files; // watchedName() of all that it is made of; empty before it was compiled

    uint64_t version = 0;    // counts changes of these
    bool waits = false;      // to be compiled
    uint32_t compiling = 0;  // threads that do: an older version may still be on its way
    bool is_running = false; // somebody who is attached runs it
    CheckedKernel latest;
    std::vector<LibraryReplacement> ready; // of `latest`, where that is another than `taken`
    KernelWords taken;                     // over, now or at the next swap; none: those that the host was built with
    bool is_certain = true;                // false: something went wrong when it was taken over

    bool wasChecked() const { return !files.empty(); }
    bool isTaken(const KernelWords& words) const {
        return is_certain && (taken ? std::ranges::equal(*words, *taken) : std::ranges::equal(*words, host->words));
    }
};

} // namespace engine
