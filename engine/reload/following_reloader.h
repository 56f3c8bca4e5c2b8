// The reloader at work: threads that watch and compile (following_reloader.cpp), and what the program's own thread takes over
// from them between two frames (taking_over.cpp).
#pragma once

#include "engine/reload/ahead_compiler.h"
#include "engine/reload/checking_process.h"
#include "engine/reload/folder_watch.h"
#include "engine/reload/followed_kernel.h"
#include "engine/reload/shader_reloader.h"

#include <condition_variable>
#include <functional>
#include <optional>
#include <shared_mutex>
#include <thread>

namespace engine {

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
    FollowingReloader(Device& device, ReloadOptions options, std::unique_ptr<FolderWatch> watch);
    ~FollowingReloader() override;
    void begin(); // its threads

    void attach(KernelLibrary& library) override;
    void detach(KernelLibrary& library) override;
    std::vector<ReloadEvent> swap() override;

    bool waitUntil(std::chrono::steady_clock::time_point time) override;
    bool isIdle() const override;
    bool isAwaited() const override;
    KernelState stateOf(std::string_view kernel) const override;

private:
    void guard(const std::function<void()>& work);
    void followChanges();
    bool hasStopped() const;
    void setGathering();
    void take(const FolderChanges& changes, SaveTime saved);
    void compileAll();
    std::optional<KernelIndex> nextToCompile() const;
    void compileOne(CheckingProcess& process, KernelIndex index);
    void rememberFiles(FollowedKernel& kernel, const CheckedKernel& checked) const;
    bool watchFilesOf(const CheckedKernel& checked);
    std::vector<LibraryReplacement> prepare(const FollowedKernel& kernel, CheckedKernel& checked);
    std::vector<Specialization> specializationsOf(const KernelSource& source);
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
    std::condition_variable work_, outcome_;
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

} // namespace engine
