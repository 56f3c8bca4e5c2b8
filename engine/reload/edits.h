// Which kernels have to change together. What a person saves, or saves within a moment, is one edit, and all kernels that it
// reaches through includes take it over at once, or none does: half of them would follow another convention than the rest.
// An edit that cannot be taken over stays open; a later one that reaches one of its kernels is the same edit, gone on.
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <set>
#include <vector>

namespace engine {

using KernelIndex = size_t;
using SaveTime = std::chrono::steady_clock::time_point;

struct Edit {
    std::set<KernelIndex> kernels;
    std::set<KernelIndex> undecided, refused; // among them
    SaveTime saved;
    bool at_start = false; // nobody saved anything: kernels that are sound do not wait for those that are not
};

class EditBook {
public:
    // These have changed and are undecided.
    void change(const std::set<KernelIndex>& kernels, SaveTime saved, bool at_start = false);
    // What came of one. An edit that this was the last of, if so: with nothing refused it is closed; otherwise it stays open,
    // or is, at the start, parted into those that are sound and edits of one kernel for those that are not.
    std::optional<Edit> decide(KernelIndex kernel, bool sound);
    bool isUndecided(KernelIndex kernel) const;
    bool hasUndecided() const;

private:
    std::vector<Edit> open_; // no two share a kernel
};

} // namespace engine
