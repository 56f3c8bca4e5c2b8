#include "modules/brittle/mesh/isolated.h"

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

// gcc tells by a macro of its own, clang by __has_feature, which gcc 12 does not know.
#if defined(__SANITIZE_ADDRESS__)
#define BRITTLE_ADDRESS_SANITIZER 1
#elif defined(__has_feature)
#define BRITTLE_ADDRESS_SANITIZER __has_feature(address_sanitizer)
#else
#define BRITTLE_ADDRESS_SANITIZER 0
#endif

namespace brittle {
namespace {

using Clock = std::chrono::steady_clock;

constexpr char kDone = 'd'; // stands behind all that the child has to say

enum ExitCode { kSuccess = 0, kOutOfMemory = 3, kThrew = 4 };

engine::Error brokenInput(const std::string& message) { return {engine::ErrorCode::BadInput, message}; }

uint64_t addressSpaceInUse() {
    unsigned long long pages = 0;
    if (FILE* file = std::fopen("/proc/self/statm", "r")) {
        if (std::fscanf(file, "%llu", &pages) != 1) pages = 0;
        std::fclose(file);
    }
    return pages * static_cast<uint64_t>(sysconf(_SC_PAGESIZE));
}

void limitMyself(const IsolationLimits& limits) {
    const rlimit no_core = {0, 0};
    setrlimit(RLIMIT_CORE, &no_core);
    const rlimit time = {limits.seconds, limits.seconds};
    setrlimit(RLIMIT_CPU, &time);
    if (!isolationLimitsMemory()) return;
    const rlimit memory = {addressSpaceInUse() + limits.bytes, addressSpaceInUse() + limits.bytes};
    setrlimit(RLIMIT_AS, &memory);
}

// Whatever a library prints about its failure is not for the user: the parent says it in one line.
void silence() {
    const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (nowhere < 0) return;
    dup2(nowhere, STDOUT_FILENO);
    dup2(nowhere, STDERR_FILENO);
}

bool writeAll(int pipe, const std::string& bytes) {
    for (size_t sent = 0; sent < bytes.size();) {
        const ssize_t count = write(pipe, bytes.data() + sent, bytes.size() - sent);
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) return false;
        sent += static_cast<size_t>(count);
    }
    return true;
}

[[noreturn]] void runChild(int pipe, const std::function<std::string()>& work, const IsolationLimits& limits) {
    silence();
    limitMyself(limits);
    for (const int fatal : {SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGXCPU})
        std::signal(fatal, SIG_DFL);
    int code = kSuccess;
    try {
        std::string answer = work();
        answer += kDone;
        if (!writeAll(pipe, answer)) code = kThrew;
    } catch (const std::bad_alloc&) {
        code = kOutOfMemory;
    } catch (...) {
        code = kThrew;
    }
    _exit(code); // no destructors of the parent's objects
}

// Collects what the child writes until it closes its end. False when time runs out.
bool readUntil(Clock::time_point deadline, int pipe, std::string& answer) {
    std::array<char, 65536> chunk;
    while (true) {
        const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now()).count();
        if (left <= 0) return false;
        pollfd waiting = {pipe, POLLIN, 0};
        const int ready = poll(&waiting, 1, static_cast<int>(left));
        if (ready < 0 && errno == EINTR) continue;
        if (ready == 0) return false;
        const ssize_t count = read(pipe, chunk.data(), chunk.size());
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) return true;
        answer.append(chunk.data(), static_cast<size_t>(count));
    }
}

int waitFor(pid_t child) {
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    return status;
}

engine::Result<std::string> judge(std::string answer, int status) {
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    if (code == kSuccess && answer.ends_with(kDone)) {
        answer.pop_back();
        return answer;
    }
    if (code == kOutOfMemory) return brokenInput("reading it takes too much memory; the file is damaged or too large");
    return brokenInput("the reader failed on it; the file is damaged, export it again");
}

} // namespace

bool isolationLimitsMemory() { return !BRITTLE_ADDRESS_SANITIZER; }

engine::Result<std::string> runIsolated(const std::function<std::string()>& work, const IsolationLimits& limits) {
    std::array<int, 2> ends;
    if (pipe2(ends.data(), O_CLOEXEC) != 0)
        return engine::Error{engine::ErrorCode::Internal, "no pipe to be had from the system"};
    const pid_t child = fork();
    if (child == 0) {
        close(ends[0]);
        runChild(ends[1], work, limits);
    }
    close(ends[1]);
    std::string answer;
    const bool in_time = child > 0 && readUntil(Clock::now() + std::chrono::seconds(limits.seconds), ends[0], answer);
    close(ends[0]);
    if (child < 0) return engine::Error{engine::ErrorCode::Internal, "no process to be had from the system"};
    if (!in_time) kill(child, SIGKILL);
    const int status = waitFor(child);
    if (!in_time)
        return brokenInput("reading it takes longer than " + std::to_string(limits.seconds) + " s; the file is damaged");
    return judge(std::move(answer), status);
}

} // namespace brittle
