#include "tools/device_check/child_process.h"

#include "tools/device_check/spawn.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <mutex>
#include <poll.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace device_check {
namespace {

constexpr size_t kErrorBytes = 4096;
constexpr std::chrono::milliseconds kPoll{50};
constexpr std::chrono::seconds kDeathPatience{5};

class Pipe {
public:
    Pipe() { open_ = pipe2(ends_.data(), O_CLOEXEC) == 0; }
    ~Pipe() {
        closeEnd(0);
        closeEnd(1);
    }
    Pipe(const Pipe&) = delete;
    Pipe& operator=(const Pipe&) = delete;
    bool isOpen() const { return open_; }
    int reading() const { return ends_[0]; }
    int writing() const { return ends_[1]; }
    void closeEnd(size_t end) {
        if (ends_[end] >= 0) close(ends_[end]);
        ends_[end] = -1;
    }

private:
    std::array<int, 2> ends_{-1, -1};
    bool open_ = false;
};

// The programs that run now. Their groups are ended if this process is interrupted.
std::mutex running_mutex;
std::vector<pid_t> running;

int spawn(const ChildCommand& command, const Pipe& out, const Pipe& errors, pid_t& pid) {
    const std::lock_guard lock(running_mutex);
    const int failed = spawnFollower(command.words, command.environment, {out.writing(), errors.writing()}, pid);
    if (failed == 0) running.push_back(pid);
    return failed;
}

void forget(pid_t pid) {
    const std::lock_guard lock(running_mutex);
    std::erase(running, pid);
}

// Cuts what arrives into lines.
class Lines {
public:
    explicit Lines(const LineHandler& handler) : handler_(handler) {}
    ~Lines() {
        if (!rest_.empty()) handler_(rest_);
    }
    Lines(const Lines&) = delete;
    Lines& operator=(const Lines&) = delete;
    bool add(std::string_view bytes) {
        rest_ += bytes;
        bool complete = false;
        for (size_t end = rest_.find('\n'); end != std::string::npos; end = rest_.find('\n')) {
            handler_(std::string_view(rest_).substr(0, end));
            rest_.erase(0, end + 1);
            complete = true;
        }
        return complete;
    }

private:
    const LineHandler& handler_;
    std::string rest_;
};

void keepLast(std::string& errors, std::string_view bytes) {
    errors += bytes;
    if (errors.size() > kErrorBytes) errors.erase(0, errors.size() - kErrorBytes);
}

// Reads until both pipes are closed or a limit is reached. Returns the limit, or Exited.
ChildEnd::Kind follow(const ChildCommand& command, Pipe& out, Pipe& errors, const LineHandler& handler, std::string& said) {
    Lines lines(handler);
    std::array<pollfd, 2> ends{pollfd{out.reading(), POLLIN, 0}, pollfd{errors.reading(), POLLIN, 0}};
    Clock::time_point last_line = Clock::now();
    std::array<char, 1 << 16> bytes;
    while (ends[0].fd >= 0 || ends[1].fd >= 0) {
        const auto now = Clock::now();
        if (now >= command.until) return ChildEnd::Kind::OutOfTime;
        if (command.patience.count() > 0 && now - last_line > command.patience) return ChildEnd::Kind::Silent;
        if (poll(ends.data(), ends.size(), static_cast<int>(kPoll.count())) <= 0) continue;
        for (size_t k = 0; k < ends.size(); ++k) {
            if (ends[k].fd < 0 || ends[k].revents == 0) continue;
            const ssize_t got = read(ends[k].fd, bytes.data(), bytes.size());
            if (got < 0 && errno == EINTR) continue;
            if (got <= 0) {
                ends[k].fd = -1;
                continue;
            }
            const std::string_view arrived(bytes.data(), static_cast<size_t>(got));
            if (k == 1)
                keepLast(said, arrived);
            else if (lines.add(arrived))
                last_line = Clock::now();
        }
    }
    return ChildEnd::Kind::Exited;
}

// False if the process does not end: a driver holds it.
bool waitFor(pid_t pid, Clock::time_point until, int& status) {
    for (;;) {
        const pid_t ended = waitpid(pid, &status, WNOHANG);
        if (ended == pid || (ended < 0 && errno != EINTR)) return true;
        if (Clock::now() > until) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
}

std::string lastLineOf(const std::string& errors) {
    const size_t end = errors.find_last_not_of("\n ");
    if (end == std::string::npos) return "";
    const size_t begin = errors.find_last_of('\n', end);
    return errors.substr(begin == std::string::npos ? 0 : begin + 1, end - (begin == std::string::npos ? 0 : begin + 1) + 1);
}

std::string reasonOf(const ChildEnd& end, const ChildCommand& command) {
    const std::string said = lastLineOf(end.errors);
    switch (end.kind) {
    case ChildEnd::Kind::Exited: return end.code == 0 ? "" : said.empty() ? "exit code " + std::to_string(end.code) : said;
    case ChildEnd::Kind::Signaled:
        return "ended by signal " + std::to_string(end.code) + " (" + strsignal(end.code) + ")" +
               (said.empty() ? "" : ": " + said);
    case ChildEnd::Kind::OutOfTime: return "ended at its time limit";
    case ChildEnd::Kind::Silent:
        return "ended after " + std::to_string(command.patience.count()) + " s without a word; the device may hang";
    default: return end.reason;
    }
}

// Takes the exit status if the process ends by itself soon, else ends its process group.
void finish(pid_t pid, ChildEnd& end) {
    int status = 0;
    const bool limited = end.kind != ChildEnd::Kind::Exited;
    if (!limited && waitFor(pid, Clock::now() + kDeathPatience, status)) {
        end.kind = WIFEXITED(status) ? ChildEnd::Kind::Exited : ChildEnd::Kind::Signaled;
        end.code = WIFEXITED(status) ? WEXITSTATUS(status) : WTERMSIG(status);
        return;
    }
    if (!limited) end.kind = ChildEnd::Kind::Silent;
    kill(-pid, SIGKILL);
    waitFor(pid, Clock::now() + kDeathPatience, status);
}

} // namespace

ChildEnd runChild(const ChildCommand& command, const LineHandler& line) {
    ChildEnd end;
    const auto start = Clock::now();
    Pipe out, errors;
    pid_t pid = -1;
    const int failed = out.isOpen() && errors.isOpen() ? spawn(command, out, errors, pid) : errno;
    if (failed != 0) {
        end.reason = command.words[0] + " cannot be started: " + std::strerror(failed);
        return end;
    }
    out.closeEnd(1);
    errors.closeEnd(1);
    end.kind = follow(command, out, errors, line, end.errors);
    finish(pid, end);
    forget(pid);
    end.seconds = std::chrono::duration<double>(Clock::now() - start).count();
    end.reason = reasonOf(end, command);
    return end;
}

void endChildren() {
    running_mutex.lock(); // for good: nothing new is started
    for (const pid_t pid : running)
        kill(-pid, SIGKILL);
    const auto until = Clock::now() + std::chrono::seconds(1);
    const auto is_left = [](pid_t pid) { return kill(-pid, 0) == 0; };
    while (std::ranges::any_of(running, is_left) && Clock::now() < until)
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
}

std::string ownPath() {
    std::error_code unreadable;
    return std::filesystem::read_symlink("/proc/self/exe", unreadable).string();
}

} // namespace device_check
