#include "engine/reload/following_reloader.h"

#include <algorithm>
#include <iterator>

namespace engine {
namespace {

using Clock = std::chrono::steady_clock;

double msSince(Clock::time_point start) { return std::chrono::duration<double, std::milli>(Clock::now() - start).count(); }

} // namespace

// With the lock held: all of an edit is decided.
void FollowingReloader::finish(const Edit& edit) {
    if (!edit.refused.empty()) refuse(edit);
    if (!edit.refused.empty() && !edit.at_start) return;
    ReadyEdit ready = gather(edit);
    if (!ready.event.kernels.empty()) ready_.push_back(std::move(ready));
}

// What is sound of it. What compiles to what it was is left out, unless all does, or nobody runs it.
ReadyEdit FollowingReloader::gather(const Edit& edit) {
    ReadyEdit ready = {{.at_start = edit.at_start}, edit.saved, {}, {}, {}};
    std::vector<std::string> sound;
    for (const KernelIndex k : edit.kernels) {
        FollowedKernel& kernel = kernels_[k];
        if (edit.refused.contains(k)) continue;
        sound.push_back(kernel.source.name);
        ready.event.runs = ready.event.runs || kernel.is_running;
        ready.event.compiling_ms += kernel.latest.ms;
        if (kernel.isTaken(kernel.latest.words)) continue;
        ready.event.kernels.push_back(kernel.source.name);
        ready.kernels.push_back(k);
        ready.words.push_back(kernel.latest.words);
        std::ranges::move(kernel.ready, std::back_inserter(ready.replacements));
        kernel.ready.clear();
        kernel.taken = kernel.latest.words;
        kernel.is_certain = true;
    }
    using Kind = ReloadEvent::Kind;
    ready.event.kind = !ready.event.runs ? Kind::Checked : ready.kernels.empty() ? Kind::Unchanged : Kind::Reloaded;
    if (ready.event.kind != Kind::Reloaded) ready.event.kernels = std::move(sound);
    return ready;
}

void FollowingReloader::refuse(const Edit& edit) {
    ReloadEvent event = {.kind = ReloadEvent::Kind::Refused, .at_start = edit.at_start, .since_save_ms = msSince(edit.saved)};
    for (const KernelIndex k : edit.kernels) {
        const FollowedKernel& kernel = kernels_[k];
        const bool is_refused = edit.refused.contains(k);
        if (!is_refused && !edit.at_start) event.waiting.push_back(kernel.source.name);
        event.runs = event.runs || kernel.is_running;
        if (!is_refused) continue;
        event.kernels.push_back(kernel.source.name);
        for (const Diagnostic& diagnostic : kernel.latest.diagnostics) // kernels may share the mistake
            if (std::ranges::find(event.diagnostics, textOf(diagnostic), [](const Diagnostic& d) { return textOf(d); }) ==
                event.diagnostics.end())
                event.diagnostics.push_back(diagnostic);
    }
    events_.push_back(std::move(event));
}

bool FollowingReloader::isRunning(const KernelSource& source) const {
    return std::ranges::any_of(libraries_, [&](const KernelLibrary* library) { return library->has(source.name); });
}

// What was taken over before holds for the newcomer, too; what nobody has looked at yet is looked at now.
void FollowingReloader::attach(KernelLibrary& library) {
    const std::unique_lock libraries(libraries_mutex_);
    libraries_.push_back(&library);
    const std::lock_guard lock(mutex_);
    ReadyEdit before;
    std::set<KernelIndex> running, others;
    for (KernelIndex k = 0; k < kernels_.size(); ++k) {
        FollowedKernel& kernel = kernels_[k];
        kernel.is_running = isRunning(kernel.source);
        if (kernel.taken) {
            before.kernels.push_back(k);
            before.words.push_back(kernel.taken);
        }
        if (is_following_) continue;
        kernel.waits = true;
        (kernel.is_running ? running : others).insert(k);
    }
    is_following_ = true;
    edits_.change(running, Clock::now(), true);
    edits_.change(others, Clock::now(), true);
    if (auto adopted = adoptInto(library, before); !adopted) tell(adopted.error().message);
    work_.notify_all();
}

void FollowingReloader::detach(KernelLibrary& library) {
    const std::unique_lock libraries(libraries_mutex_);
    std::erase(libraries_, &library);
    const std::lock_guard lock(mutex_);
    const auto isOf = [&](const LibraryReplacement& replacement) { return replacement.library == &library; };
    for (FollowedKernel& kernel : kernels_) {
        std::erase_if(kernel.ready, isOf);
        kernel.is_running = isRunning(kernel.source);
    }
    for (ReadyEdit& ready : ready_)
        std::erase_if(ready.replacements, isOf);
}

Result<void> FollowingReloader::adopt(ReadyEdit& ready) {
    const std::shared_lock libraries(libraries_mutex_);
    for (KernelLibrary* library : libraries_)
        if (auto adopted = adoptInto(*library, ready); !adopted) return adopted;
    return {};
}

// Of one that came after they were made ready, they are made now.
Result<void> FollowingReloader::adoptInto(KernelLibrary& library, ReadyEdit& ready) {
    std::vector<KernelReplacement> own;
    for (size_t k = 0; k < ready.kernels.size(); ++k) {
        const std::string& name = kernels_[ready.kernels[k]].source.name; // which never changes
        const auto made = std::ranges::find_if(ready.replacements, [&](const LibraryReplacement& r) {
            return r.library == &library && r.replacement.name == name;
        });
        if (made != ready.replacements.end()) {
            own.push_back(std::move(made->replacement));
            continue;
        }
        auto replacement = library.prepare(name, ready.words[k]);
        if (!replacement) return replacement.error();
        own.push_back(std::move(*replacement));
    }
    return library.adopt(own);
}

bool FollowingReloader::waitUntil(Clock::time_point time) {
    std::unique_lock lock(mutex_);
    return outcome_.wait_until(lock, time, [&] { return !ready_.empty() || !events_.empty(); });
}

std::vector<ReloadEvent> FollowingReloader::swap() {
    std::vector<ReadyEdit> ready;
    std::vector<ReloadEvent> events;
    {
        const std::lock_guard lock(mutex_);
        ready.swap(ready_);
        events.swap(events_);
    }
    for (ReadyEdit& edit : ready) {
        auto adopted = adopt(edit);
        const std::lock_guard lock(mutex_);
        for (const KernelIndex k : edit.kernels)
            kernels_[k].is_certain = adopted.has_value();
        edit.event.since_save_ms = msSince(edit.saved);
        if (!adopted) {
            edit.event.kind = ReloadEvent::Kind::Refused;
            edit.event.diagnostics = {{Severity::Error, options_.folder.string(), 0, 0, adopted.error().message}};
        }
        events.push_back(std::move(edit.event));
    }
    return events;
}

} // namespace engine
