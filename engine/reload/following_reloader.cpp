#include "engine/reload/following_reloader.h"

#include <algorithm>
#include <exception>

namespace engine {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

// Editors write a file in several goes, and people save several files at once: what follows within a moment belongs together.
constexpr milliseconds kQuiet{8}, kLongest{60}, kForever{3600 * 1000};

Diagnostic aboutWhole(const KernelSource& source, const std::string& why) {
    return {Severity::Error, source.file.string(), 0, 0, "kernel \"" + source.name + "\": " + why};
}

} // namespace

FollowingReloader::FollowingReloader(Device& device, ReloadOptions options, std::unique_ptr<FolderWatch> watch)
    : device_(device), options_(std::move(options)), watch_(std::move(watch)) {
    if (options_.include_folders.empty()) options_.include_folders = {options_.folder};
    for (const shaders::Module& module : options_.modules)
        kernels_.push_back({.source = sourceOf(module, options_.folder), .host = &module});
}

FollowingReloader::~FollowingReloader() {
    {
        const std::lock_guard lock(mutex_);
        stops_ = true;
    }
    watch_->wake();
    work_.notify_all();
    threads_.clear();
}

void FollowingReloader::begin() {
    const uint32_t cores = std::max(1u, std::thread::hardware_concurrency());
    for (uint32_t k = 0; k < (options_.threads == 0 ? cores : options_.threads); ++k)
        threads_.emplace_back([this] { guard([this] { compileAll(); }); });
    threads_.emplace_back([this] { guard([this] { followChanges(); }); });
}

bool FollowingReloader::isIdle() const {
    const std::lock_guard lock(mutex_);
    return !edits_.hasUndecided() && ready_.empty() && events_.empty() && !gathers_;
}

bool FollowingReloader::isAwaited() const {
    const std::lock_guard lock(mutex_);
    return std::ranges::any_of(kernels_, [](const FollowedKernel& k) { return k.is_running && (k.waits || k.compiling > 0); });
}

KernelState FollowingReloader::stateOf(std::string_view kernel) const {
    const std::lock_guard lock(mutex_);
    const auto found = std::ranges::find(kernels_, kernel, [](const FollowedKernel& k) { return k.source.name; });
    if (found == kernels_.end() || !found->wasChecked()) return KernelState::Unchecked;
    return found->latest.good() ? KernelState::Ready : KernelState::Refused;
}

bool FollowingReloader::hasStopped() const {
    const std::lock_guard lock(mutex_);
    return stops_;
}

void FollowingReloader::setGathering() {
    const std::lock_guard lock(mutex_);
    gathers_ = true;
}

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
        const bool is_meant =
            changes.everything || !kernel.latest.knows_files ||
            std::ranges::any_of(changes.files, [&](const fs::path& file) { return kernel.files.contains(file); });
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
    CheckingProcess process({.shared_bytes = device_.limits().maxComputeSharedMemorySize});
    for (;;) {
        std::optional<KernelIndex> next;
        {
            std::unique_lock lock(mutex_);
            work_.wait(lock, [&] { return stops_ || (next = nextToCompile()); });
            if (stops_) return;
            kernels_[*next].waits = false;
            ++kernels_[*next].compiling;
        }
        compileOne(process, *next);
        const std::lock_guard lock(mutex_);
        --kernels_[*next].compiling;
        work_.notify_all();
        outcome_.notify_all();
    }
}

// What runs before what does not, which takes no core from it either, and what somebody has saved before what was there; of
// these first what took longest when it was compiled last, so that nothing long is begun in the end.
std::optional<KernelIndex> FollowingReloader::nextToCompile() const {
    const bool somebody_waits =
        std::ranges::any_of(kernels_, [](const FollowedKernel& k) { return k.is_running && k.compiling > 0; });
    std::optional<KernelIndex> best;
    int best_rank = -1;
    for (KernelIndex k = 0; k < kernels_.size(); ++k) {
        const FollowedKernel& kernel = kernels_[k];
        const int rank = (kernel.is_running ? 2 : 0) + (kernel.wasChecked() ? 1 : 0);
        if (!kernel.waits || rank < best_rank || (somebody_waits && !kernel.is_running)) continue;
        if (rank == best_rank && kernel.latest.ms <= kernels_[*best].latest.ms) continue;
        best = k;
        best_rank = rank;
    }
    return best;
}

void FollowingReloader::compileOne(CheckingProcess& process, KernelIndex index) {
    FollowedKernel kernel; // as it was asked for
    {
        const std::lock_guard lock(mutex_);
        kernel = kernels_[index];
    }
    CheckedKernel checked;
    std::vector<LibraryReplacement> ready;
    bool is_known = true;
    try {
        checked = process.check(kernel.source, kernel.host, options_.include_folders, [&] {
            const std::lock_guard lock(mutex_);
            return stops_ || kernels_[index].version != kernel.version;
        });
        is_known = watchFilesOf(checked);
        if (is_known && checked.good() && !kernel.isTaken(checked.words)) ready = prepare(kernel, checked);
    } catch (const std::exception& thrown) { // nothing that is thrown here is worth the process
        checked.words = nullptr;
        checked.diagnostics = {aboutWhole(kernel.source, thrown.what())};
    }
    const std::shared_lock libraries(libraries_mutex_);
    const std::lock_guard lock(mutex_);
    std::erase_if(ready, [&](const LibraryReplacement& made) { return std::ranges::count(libraries_, made.library) == 0; });
    FollowedKernel& followed = kernels_[index];
    rememberFiles(followed, checked);
    if (stops_ || followed.version != kernel.version) return; // it waits again already
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

// Pipelines are made while the driver compiles ahead.
std::vector<LibraryReplacement> FollowingReloader::prepare(const FollowedKernel& kernel, CheckedKernel& checked) {
    const AheadCompilation compiling(device_, kernel.source.name, checked.words, specializationsOf(kernel.source));
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
    }
    return ready;
}

// Each once, whoever runs them.
std::vector<Specialization> FollowingReloader::specializationsOf(const KernelSource& source) {
    const auto isSame = [](const SpecConstant& a, const SpecConstant& b) { return a.id == b.id && a.value == b.value; };
    const std::shared_lock lock(libraries_mutex_);
    std::vector<Specialization> all;
    for (const KernelLibrary* library : libraries_)
        for (Specialization& constants : library->specializationsOf(source.name))
            if (std::ranges::none_of(all, [&](const auto& known) { return std::ranges::equal(known, constants, isSame); }))
                all.push_back(std::move(constants));
    return all;
}

bool somethingRuns(std::span<const ReloadEvent> events) {
    return std::ranges::any_of(events, [](const ReloadEvent& e) { return e.kind == ReloadEvent::Kind::Reloaded; });
}

Result<std::unique_ptr<ShaderReloader>> ShaderReloader::start(Device& device, ReloadOptions options) {
    std::error_code error;
    if (!fs::is_directory(options.folder, error)) return Error{ErrorCode::BadInput, options.folder.string() + ": is no folder"};
    const auto hasFile = [&](const shaders::Module& module) { return fs::exists(options.folder / module.file, error); };
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
