#include "tools/brittle/interrupt.h"

#include <csignal>
#include <mutex>
#include <thread>
#include <vector>

namespace cli {
namespace {

std::mutex begun_mutex;
std::vector<std::filesystem::path> begun_files;        // named after this process, so that what is still there is ours
std::vector<std::filesystem::path> made_folders; // folders, the outermost first
std::vector<std::function<void()>> actions;

// Signals that are ignored when the program starts stay so: nohup wants that.
bool isIgnored(int signal) {
    struct sigaction action {};
    return sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

sigset_t interrupts() {
    sigset_t set;
    sigemptyset(&set);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP})
        if (!isIgnored(signal)) sigaddset(&set, signal);
    return set;
}

// Others are left, as std::filesystem::remove has it.
void removeEmpty(const std::vector<std::filesystem::path>& folders) {
    std::error_code ignored;
    for (auto folder = folders.rbegin(); folder != folders.rend(); ++folder)
        std::filesystem::remove(*folder, ignored);
}

std::vector<std::filesystem::path> missingFolders(const std::filesystem::path& path) {
    std::vector<std::filesystem::path> missing;
    std::error_code ignored;
    for (std::filesystem::path at = std::filesystem::absolute(path, ignored);
         !at.empty() && !std::filesystem::exists(at, ignored); at = at.parent_path())
        missing.insert(missing.begin(), at);
    return missing;
}

// In order, so that what may just be written goes last. Nothing new is begun_files any more: the mutex stays locked.
void removeBegun() {
    begun_mutex.lock();
    std::error_code ignored;
    for (const std::filesystem::path& path : begun_files)
        std::filesystem::remove(path, ignored);
    removeEmpty(made_folders);
}

// As if nobody had waited for it.
void endBy(int signal) {
    std::signal(signal, SIG_DFL);
    const sigset_t set = interrupts();
    pthread_sigmask(SIG_UNBLOCK, &set, nullptr);
    std::raise(signal);
}

} // namespace

void cleanUpWhenInterrupted() {
    const sigset_t set = interrupts();
    pthread_sigmask(SIG_BLOCK, &set, nullptr); // by all threads that come after
    std::thread([set] {
        int signal = 0;
        if (sigwait(&set, &signal) != 0) return;
        removeBegun();
        for (const auto& action : actions)
            action();
        endBy(signal);
    }).detach();
}

void whenInterrupted(std::function<void()> action) {
    const std::lock_guard lock(begun_mutex);
    actions.push_back(std::move(action));
}

engine::Result<brittle::OutputFile> createOutput(const std::filesystem::path& path) {
    const std::lock_guard lock(begun_mutex);
    auto file = brittle::OutputFile::create(path);
    if (file) begun_files.push_back(file->temporaryPath());
    return file;
}

engine::Result<OutputFolder> OutputFolder::create(const std::filesystem::path& path) {
    OutputFolder folder; // before the lock, which it takes where it goes
    const std::lock_guard lock(begun_mutex);
    folder.made_ = missingFolders(path);
    made_folders.insert(made_folders.end(), folder.made_.begin(), folder.made_.end());
    std::error_code failed;
    std::filesystem::create_directories(path, failed);
    if (failed)
        return engine::Error{engine::ErrorCode::BadInput,
                             path.string() + ": cannot be made: " + failed.message() + "; give another folder with -o"};
    return folder;
}

OutputFolder::~OutputFolder() {
    if (made_.empty()) return; // what was moved from is destroyed under the lock
    const std::lock_guard lock(begun_mutex);
    removeEmpty(made_);
}

} // namespace cli
