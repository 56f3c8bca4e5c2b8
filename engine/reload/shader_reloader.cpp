#include "engine/reload/shader_reloader.h"

#include "engine/reload/ahead_compiler.h"
#include "engine/reload/folder_watch.h"
#include "engine/reload/followed_kernel.h"

#include <algorithm>
#include <condition_variable>
#include <exception>
#include <functional>
#include <optional>
#include <shared_mutex>
#include <thread>

namespace engine {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

// Editors write a file in several goes, and people save several files at once: what follows within a moment belongs together.
constexpr milliseconds kQuiet{8}, kLongest{60}, kForever{3600 * 1000};

double msSince(Clock::time_point start) { return std::chrono::duration<double, std::milli>(Clock::now() - start).count(); }

Diagnostic aboutWhole(const KernelSource& source, const std::string& why) {
    return {Severity::Error, source.file.string(), 0, 0, "kernel \"" + source.name + "\": " + why};
}

// The outcome of an edit that is ready to be taken over.
struct ReadyEdit {
    ReloadEvent event;
    SaveTime saved;
    std::vector<KernelIndex> kernels;
    std::vector<KernelWords> words; // of these
    std::vector<LibraryReplacement> replacements;
};

// The lists of kernels are guarded by mutex_, which nobody holds while something is compiled; libraries_mutex_ keeps libraries
// where they are while pipelines are made for them.
class FollowingReloader : public ShaderReloader {
public:
    FollowingReloader(Device& device, ReloadOptions options, std::unique_ptr<FolderWatch> watch)
        : device_(device), options_(std::move(options)), watch_(std::move(watch)) {
        if (options_.include_folders.empty()) options_.include_folders = {options_.folder};
        for (const shaders::Module& module : options_.modules)
            kernels_.push_back({.source = sourceOf(module, options_.folder), .host = &module});
    }

    ~FollowingReloader() override {
        {
            const std::lock_guard lock(mutex_);
            stops_ = true;
        }
        watch_->wake();
        work_.notify_all();
        threads_.clear();
    }

    void begin() {
        const uint32_t spare = std::max(2u, std::thread::hardware_concurrency()) - 1;
        for (uint32_t k = 0; k < (options_.threads == 0 ? spare : options_.threads); ++k)
            threads_.emplace_back([this] { guard([this] { compileAll(); }); });
        threads_.emplace_back([this] { guard([this] { followChanges(); }); });
    }

    void attach(KernelLibrary& library) override;
    void detach(KernelLibrary& library) override;
    std::vector<ReloadEvent> swap() override;

    bool isIdle() const override {
        const std::lock_guard lock(mutex_);
        return !edits_.hasUndecided() && ready_.empty() && events_.empty() && !gathers_;
    }

    KernelState stateOf(std::string_view kernel) const override {
        const std::lock_guard lock(mutex_);
        const auto found = std::ranges::find(kernels_, kernel, [](const FollowedKernel& k) { return k.source.name; });
        if (found == kernels_.end() || !found->wasChecked()) return KernelState::Unchecked;
        return found->latest.good() ? KernelState::Ready : KernelState::Refused;
    }

private:
    void guard(const std::function<void()>& work);
    void followChanges();
    bool hasStopped() const {
        const std::lock_guard lock(mutex_);
        return stops_;
    }
    void setGathering() {
        const std::lock_guard lock(mutex_);
        gathers_ = true;
    }
    void take(const FolderChanges& changes, SaveTime saved);
    void compileAll();
    std::optional<KernelIndex> nextToCompile() const;
    void compileOne(KernelIndex index, AheadCompiler& ahead);
    void rememberFiles(FollowedKernel& kernel, const CheckedKernel& checked) const;
    bool watchFilesOf(const CheckedKernel& checked);
    std::vector<LibraryReplacement> prepare(const FollowedKernel& kernel, CheckedKernel& checked, AheadCompiler& ahead);
    void finish(const Edit& edit);
    void refuse(const Edit& edit);
    ReadyEdit gather(const Edit& edit);
    Result<void> adopt(ReadyEdit& ready);
    Result<void> adoptInto(KernelLibrary& library, ReadyEdit& ready);
    bool isRunning(const KernelSource& source) const;
    void tell(const std::string& trouble) { events_.push_back({.kind = ReloadEvent::Kind::Trouble, .message = trouble}); }

    Device& device_;
    ReloadOptions options_;
    std::unique_ptr<FolderWatch> watch_;

    mutable std::mutex mutex_;
    std::condition_variable work_;
    std::vector<FollowedKernel> kernels_;
    EditBook edits_;
    std::vector<ReadyEdit> ready_;
    std::vector<ReloadEvent> events_;
    bool stops_ = false;
    bool is_following_ = false; // somebody was attached
    bool gathers_ = false;      // changes that it has heard of and not yet looked at

    std::shared_mutex libraries_mutex_;
    std::vector<KernelLibrary*> libraries_;
    std::vector<std::jthread> threads_;
};

// What is thrown on a thread ends the process, and nothing here is worth that.
void FollowingReloader::guard(const std::function<void()>& work) {
    try {
        work();
    } catch (const std::exception& thrown) {
        const std::lock_guard lock(mutex_);
        tell(std::string("kernels are no longer reloaded: ") + thrown.what());
    }
}

void FollowingReloader::followChanges() {
    // Whoever stops it says so before waking it: of two waits below either may be the one that is woken.
    while (!hasStopped()) {
        FolderChanges changes = watch_->wait(kForever);
        if (!changes.any()) continue;
        setGathering();
        const SaveTime saved = Clock::now();
        while (Clock::now() - saved < kLongest) {
            const FolderChanges more = watch_->wait(kQuiet);
            if (!more.any()) break;
            changes.files.insert(more.files.begin(), more.files.end());
            changes.troubles.insert(changes.troubles.end(), more.troubles.begin(), more.troubles.end());
            changes.everything = changes.everything || more.everything;
        }
        take(changes, saved);
    }
}

// Kernels that run and kernels that do not are edits of their own: nobody has to wait for what is not seen.
void FollowingReloader::take(const FolderChanges& changes, SaveTime saved) {
    const std::shared_lock libraries(libraries_mutex_);
    const std::lock_guard lock(mutex_);
    gathers_ = false;
    for (const std::string& trouble : changes.troubles)
        tell(trouble);
    std::set<KernelIndex> running, others;
    for (KernelIndex k = 0; k < kernels_.size(); ++k) {
        FollowedKernel& kernel = kernels_[k];
        const bool is_meant = changes.everything || std::ranges::any_of(changes.files, [&](const fs::path& file) {
                                  return kernel.files.contains(file);
                              });
        if (!is_meant || !kernel.wasChecked()) continue; // one that was not will be, as it is then
        ++kernel.version;
        kernel.waits = true;
        kernel.is_running = isRunning(kernel.source);
        (kernel.is_running ? running : others).insert(k);
    }
    edits_.change(running, saved);
    edits_.change(others, saved);
    work_.notify_all();
}

void FollowingReloader::compileAll() {
    AheadCompiler ahead(device_);
    for (;;) {
        std::optional<KernelIndex> next;
        {
            std::unique_lock lock(mutex_);
            work_.wait(lock, [&] { return stops_ || (next = nextToCompile()); });
            if (stops_) return;
            kernels_[*next].waits = false;
        }
        compileOne(*next, ahead);
    }
}

// What runs before what does not, and what somebody has saved before what was there.
std::optional<KernelIndex> FollowingReloader::nextToCompile() const {
    std::optional<KernelIndex> best;
    int best_rank = -1;
    for (KernelIndex k = 0; k < kernels_.size(); ++k) {
        const FollowedKernel& kernel = kernels_[k];
        const int rank = (kernel.is_running ? 2 : 0) + (kernel.wasChecked() ? 1 : 0);
        if (!kernel.waits || rank <= best_rank) continue;
        best = k;
        best_rank = rank;
    }
    return best;
}

void FollowingReloader::compileOne(KernelIndex index, AheadCompiler& ahead) {
    FollowedKernel kernel; // as it was asked for
    {
        const std::lock_guard lock(mutex_);
        kernel = kernels_[index];
    }
    CheckedKernel checked;
    std::vector<LibraryReplacement> ready;
    bool is_known = true;
    try {
        checked = checkKernel(kernel.source, kernel.host, options_.include_folders);
        is_known = watchFilesOf(checked);
        if (is_known && checked.good() && !kernel.isTaken(checked.words)) ready = prepare(kernel, checked, ahead);
    } catch (const std::exception& thrown) { // nothing that is thrown here is worth the process
        checked.words = nullptr;
        checked.diagnostics = {aboutWhole(kernel.source, thrown.what())};
    }
    const std::lock_guard lock(mutex_);
    FollowedKernel& followed = kernels_[index];
    rememberFiles(followed, checked);
    if (followed.version != kernel.version) return; // it waits again already
    if (!is_known) {
        followed.waits = true; // what was read may have changed before it was watched
        work_.notify_all();
        return;
    }
    followed.latest = std::move(checked);
    followed.ready = std::move(ready);
    if (const auto edit = edits_.decide(index, followed.latest.good())) finish(*edit);
}

void FollowingReloader::rememberFiles(FollowedKernel& kernel, const CheckedKernel& checked) const {
    for (const fs::path& file : checked.files) {
        kernel.files.insert(watchedName(file));
        std::error_code error;
        if (const fs::path target = fs::canonical(file, error); !error) kernel.files.insert(target);
    }
    kernel.files.insert(watchedName(kernel.source.file));
}

// Also what links lead to, and what lies in other folders. False where something was not watched while it was read.
bool FollowingReloader::watchFilesOf(const CheckedKernel& checked) {
    bool all_known = true;
    for (const fs::path& file : checked.files) {
        std::error_code error;
        for (const fs::path& name : {file, fs::canonical(file, error)}) {
            if (name.empty() || !fs::is_directory(name.parent_path(), error)) continue;
            const auto added = watch_->addFolder(name.parent_path());
            if (added && *added) all_known = false;
            if (added) continue;
            const std::lock_guard lock(mutex_);
            tell(added.error().message);
        }
    }
    return all_known;
}

std::vector<LibraryReplacement> FollowingReloader::prepare(const FollowedKernel& kernel, CheckedKernel& checked,
                                                           AheadCompiler& ahead) {
    const std::shared_lock lock(libraries_mutex_);
    std::vector<LibraryReplacement> ready;
    for (KernelLibrary* library : libraries_) {
        auto replacement = library->prepare(kernel.source.name, checked.words);
        if (!replacement) {
            checked.words = nullptr;
            checked.diagnostics.push_back(aboutWhole(kernel.source, replacement.error().message));
            return {};
        }
        ready.push_back({library, std::move(*replacement)});
        ahead.compile(kernel.source.name, checked.words, library->specializationsOf(kernel.source.name));
    }
    return ready;
}

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

} // namespace

bool somethingRuns(std::span<const ReloadEvent> events) {
    return std::ranges::any_of(events, [](const ReloadEvent& e) { return e.kind == ReloadEvent::Kind::Reloaded; });
}

Result<std::unique_ptr<ShaderReloader>> ShaderReloader::start(Device& device, ReloadOptions options) {
    const auto hasFile = [&](const shaders::Module& module) {
        std::error_code error;
        return fs::exists(options.folder / module.file, error);
    };
    if (std::ranges::none_of(options.modules, hasFile))
        return Error{ErrorCode::BadInput, options.folder.string() + ": has none of the kernels that run here; give the folder "
                                                                    "that holds their table, such as shaders-spirv"};
    auto watch = FolderWatch::create();
    if (!watch) return watch.error();
    if (auto added = (*watch)->addTree(options.folder); !added) return added.error();
    for (const fs::path& folder : options.include_folders)
        if (auto added = (*watch)->addTree(folder); !added) return added.error();
    auto reloader = std::make_unique<FollowingReloader>(device, std::move(options), std::move(*watch));
    reloader->begin();
    return std::unique_ptr<ShaderReloader>(std::move(reloader));
}

} // namespace engine
