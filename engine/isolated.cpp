#include "engine/isolated.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>
#include <utility>

// gcc tells by a macro of its own, clang by __has_feature, which gcc 12 does not know.
#if defined(__SANITIZE_ADDRESS__)
#define ENGINE_ADDRESS_SANITIZER 1
#elif defined(__has_feature)
#define ENGINE_ADDRESS_SANITIZER __has_feature(address_sanitizer)
#else
#define ENGINE_ADDRESS_SANITIZER 0
#endif

namespace engine {
namespace {

using Clock = std::chrono::steady_clock;
using End = IsolatedRun::End;
using std::chrono::milliseconds;

constexpr milliseconds kBetweenQuestions{5}; // whether it is still wanted
constexpr milliseconds kLongestPause{1000};  // of a child that does something
constexpr int kMostForks = 4;                // of one that does nothing

enum ExitCode { kNothingMoreAsked = 0, kOutOfMemory = 3, kThrew = 4 };

uint64_t addressSpaceInUse() {
    unsigned long long pages = 0;
    if (FILE* file = std::fopen("/proc/self/statm", "r")) {
        if (std::fscanf(file, "%llu", &pages) != 1) pages = 0;
        std::fclose(file);
    }
    return pages * static_cast<uint64_t>(sysconf(_SC_PAGESIZE));
}

void limitMemory(const IsolationLimits& limits) {
    const rlimit no_core = {0, 0};
    setrlimit(RLIMIT_CORE, &no_core);
    if (!isolationLimitsMemory()) return;
    const rlim_t most = addressSpaceInUse() + limits.bytes;
    const rlimit memory = {most, most};
    setrlimit(RLIMIT_AS, &memory);
}

// From now on; a little more than the parent allows, for a child that it no longer looks after.
void limitTime(const IsolationLimits& limits) {
    rusage used{};
    getrusage(RUSAGE_SELF, &used);
    const rlim_t so_far = static_cast<rlim_t>(used.ru_utime.tv_sec + used.ru_stime.tv_sec);
    const rlimit time = {so_far + limits.seconds + 3, RLIM_INFINITY};
    setrlimit(RLIMIT_CPU, &time);
}

// Whatever a library prints about its failure is not for the user: the parent says it in one line.
void silence() {
    const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (nowhere < 0) return;
    dup2(nowhere, STDOUT_FILENO);
    dup2(nowhere, STDERR_FILENO);
}

void closeAllBut(int socket) {
    const auto own = static_cast<unsigned>(socket);
    constexpr unsigned kFirst = STDERR_FILENO + 1;
    if (own > kFirst) close_range(kFirst, own - 1, 0);
    close_range(own + 1, ~0u, 0);
}

// ---- what is said between the two: its length, then its bytes ---------------------------------------------------------------

bool sendAll(int socket, const void* bytes, size_t size) {
    for (size_t sent = 0; sent < size;) {
        const ssize_t count = send(socket, static_cast<const char*>(bytes) + sent, size - sent, MSG_NOSIGNAL);
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) return false;
        sent += static_cast<size_t>(count);
    }
    return true;
}

bool say(int socket, std::string_view text) {
    const size_t size = text.size();
    return sendAll(socket, &size, sizeof size) && sendAll(socket, text.data(), size);
}

// False once the other one has closed its end.
bool hear(int socket, std::string& text) {
    std::array<char, 65536> chunk;
    const ssize_t count = recv(socket, chunk.data(), chunk.size(), 0);
    if (count > 0) text.append(chunk.data(), static_cast<size_t>(count));
    return count > 0 || (count < 0 && errno == EINTR);
}

bool isWhole(const std::string& heard) {
    size_t size = 0;
    if (heard.size() < sizeof size) return false;
    std::memcpy(&size, heard.data(), sizeof size);
    return heard.size() - sizeof size >= size;
}

std::string withoutLength(std::string heard) { return heard.erase(0, sizeof(size_t)); }

// ---- the child --------------------------------------------------------------------------------------------------------------

void answerOne(int socket, const IsolatedProcess::Work& work, const IsolationLimits& limits) {
    std::string request;
    while (!isWhole(request))
        if (!hear(socket, request)) _exit(kNothingMoreAsked);
    limitTime(limits);
    if (!say(socket, work(withoutLength(std::move(request))))) _exit(kNothingMoreAsked);
}

[[noreturn]] void runChild(int socket, const IsolatedProcess::Work& work, const IsolationLimits& limits) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    closeAllBut(socket);
    silence();
    limitMemory(limits);
    for (const int fatal : {SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGXCPU})
        std::signal(fatal, SIG_DFL);
    try {
        for (;;)
            answerOne(socket, work, limits);
    } catch (const std::bad_alloc&) {
        _exit(kOutOfMemory); // no destructors of the parent's objects
    } catch (...) {
        _exit(kThrew);
    }
}

// ---- the parent -------------------------------------------------------------------------------------------------------------

// What a process has used of processors; none where that cannot be told.
milliseconds processorTimeOf(pid_t process) {
    clockid_t clock = 0;
    timespec used{};
    if (clock_getcpuclockid(process, &clock) != 0 || clock_gettime(clock, &used) != 0) return milliseconds(-1);
    return milliseconds(used.tv_sec * 1000 + used.tv_nsec / 1'000'000);
}

int waitFor(pid_t child) {
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    return status;
}

End causeOf(int status) {
    if (WIFEXITED(status) && WEXITSTATUS(status) == kOutOfMemory) return End::OutOfMemory;
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU) return End::OutOfTime;
    return End::Died;
}

} // namespace

bool isolationLimitsMemory() { return !ENGINE_ADDRESS_SANITIZER; }

IsolatedProcess::IsolatedProcess(Work work, IsolationLimits limits) : work_(std::move(work)), limits_(limits) {}

IsolatedProcess::~IsolatedProcess() { end(); }

bool IsolatedProcess::begin() {
    std::array<int, 2> ends;
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) return false;
    child_ = fork();
    if (child_ == 0) runChild(ends[1], work_, limits_);
    close(ends[1]);
    socket_ = ends[0];
    return child_ > 0;
}

// The status that it ended with, if it had.
int IsolatedProcess::end() {
    if (socket_ >= 0) close(socket_);
    socket_ = -1;
    if (child_ <= 0) return 0;
    kill(child_, SIGKILL);
    return waitFor(std::exchange(child_, -1));
}

// When to stop waiting, and whether the child does anything.
struct IsolatedProcess::Watch {
    Clock::time_point deadline;
    bool gives_up = false; // where it does nothing
    Clock::time_point looked = Clock::now();
    milliseconds used{-1};

    bool isStuck(pid_t child) {
        if (!gives_up || Clock::now() - looked < kLongestPause) return false;
        looked = Clock::now();
        const milliseconds before = std::exchange(used, processorTimeOf(child));
        return used >= milliseconds(0) && used == before;
    }
};

// Until an answer is whole, the child has come to an end or is stuck, time runs out or nobody wants it any more.
End IsolatedProcess::hearAnswer(Watch& watch, const std::function<bool()>& is_unwanted, std::string& answer) const {
    while (!isWhole(answer)) {
        if (is_unwanted && is_unwanted()) return End::Unwanted;
        if (watch.isStuck(child_)) return End::NotBegun;
        auto left = std::chrono::duration_cast<milliseconds>(watch.deadline - Clock::now());
        if (left.count() <= 0) return End::OutOfTime;
        left = std::min(left, is_unwanted ? kBetweenQuestions : kLongestPause);
        pollfd waiting = {socket_, POLLIN, 0};
        const int ready = poll(&waiting, 1, static_cast<int>(left.count()));
        if (ready > 0 && !hear(socket_, answer)) return End::Died;
    }
    return End::Done;
}

IsolatedRun IsolatedProcess::ask(std::string_view request, const std::function<bool()>& is_unwanted) {
    for (int forks_left = kMostForks; forks_left > 0; --forks_left) {
        if (child_ <= 0 && !begin()) break;
        std::string answer;
        Watch watch = {.deadline = Clock::now() + std::chrono::seconds(limits_.seconds), .gives_up = forks_left > 1};
        const End heard = say(socket_, request) ? hearAnswer(watch, is_unwanted, answer) : End::Died;
        if (heard == End::Done) return {End::Done, withoutLength(std::move(answer))};
        const int status = end();
        if (heard != End::NotBegun) return {heard == End::Died ? causeOf(status) : heard, {}};
    }
    end();
    return {End::NotBegun, {}};
}

// What it has answered before may have left it too little memory, or have spoiled it.
IsolatedRun IsolatedProcess::run(std::string_view request, const std::function<bool()>& is_unwanted) {
    const bool is_new = child_ <= 0;
    IsolatedRun run = ask(request, is_unwanted);
    const bool is_perhaps_of_before = !is_new && (run.end == End::Died || run.end == End::OutOfMemory);
    return is_perhaps_of_before ? ask(request, is_unwanted) : run;
}

IsolatedRun runIsolated(const std::function<std::string()>& work, const IsolationLimits& limits,
                        const std::function<bool()>& is_unwanted) {
    return IsolatedProcess([&](std::string_view) { return work(); }, limits).run({}, is_unwanted);
}

} // namespace engine
