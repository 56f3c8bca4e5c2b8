#include "tools/brittle/interrupt.h"

#include <csignal>
#include <mutex>
#include <thread>
#include <vector>

namespace cli {
namespace {

std::mutex begun_mutex;
std::vector<std::filesystem::path> begun; // named after this process, so that what is still there is ours

sigset_t interrupts() {
    sigset_t set;
    sigemptyset(&set);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP})
        sigaddset(&set, signal);
    return set;
}

// In order, so that what may just be written goes last. Nothing new is begun any more: the mutex stays locked.
void removeBegun() {
    begun_mutex.lock();
    std::error_code ignored;
    for (const std::filesystem::path& path : begun)
        std::filesystem::remove(path, ignored);
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
        endBy(signal);
    }).detach();
}

engine::Result<brittle::OutputFile> createOutput(const std::filesystem::path& path) {
    const std::lock_guard lock(begun_mutex);
    auto file = brittle::OutputFile::create(path);
    if (file) begun.push_back(file->temporaryPath());
    return file;
}

} // namespace cli
