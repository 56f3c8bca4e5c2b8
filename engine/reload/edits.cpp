#include "engine/reload/edits.h"

#include <algorithm>

namespace engine {
namespace {

bool shareKernels(const Edit& edit, const std::set<KernelIndex>& kernels) {
    return std::ranges::any_of(kernels, [&](KernelIndex kernel) { return edit.kernels.contains(kernel); });
}

} // namespace

void EditBook::change(const std::set<KernelIndex>& kernels, SaveTime saved, bool at_start) {
    if (kernels.empty()) return;
    Edit edit = {kernels, kernels, {}, saved, at_start};
    for (const Edit& open : open_) {
        if (!shareKernels(open, kernels)) continue;
        edit.kernels.insert(open.kernels.begin(), open.kernels.end());
        edit.undecided.insert(open.undecided.begin(), open.undecided.end());
        edit.refused.insert(open.refused.begin(), open.refused.end());
        edit.at_start = edit.at_start || open.at_start;
    }
    for (const KernelIndex kernel : kernels)
        edit.refused.erase(kernel);
    std::erase_if(open_, [&](const Edit& open) { return shareKernels(open, kernels); });
    open_.push_back(std::move(edit));
}

std::optional<Edit> EditBook::decide(KernelIndex kernel, bool sound) {
    const auto edit = std::ranges::find_if(open_, [&](const Edit& open) { return open.undecided.contains(kernel); });
    if (edit == open_.end()) return std::nullopt;
    edit->undecided.erase(kernel);
    if (!sound) edit->refused.insert(kernel);
    if (!edit->undecided.empty()) return std::nullopt;
    const Edit decided = *edit;
    if (!decided.refused.empty() && !decided.at_start) return decided;
    open_.erase(edit);
    for (const KernelIndex refused : decided.refused)
        open_.push_back({{refused}, {}, {refused}, decided.saved, false});
    return decided;
}

bool EditBook::isUndecided(KernelIndex kernel) const {
    return std::ranges::any_of(open_, [&](const Edit& open) { return open.undecided.contains(kernel); });
}

bool EditBook::hasUndecided() const {
    return std::ranges::any_of(open_, [](const Edit& open) { return !open.undecided.empty(); });
}

} // namespace engine
