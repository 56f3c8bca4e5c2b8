#include "tools/device_check/spawn.h"

#include <cerrno>
#include <csignal>
#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace device_check {
namespace {

std::vector<char*> pointersTo(std::vector<std::string>& words) {
    std::vector<char*> pointers;
    for (std::string& word : words)
        pointers.push_back(word.data());
    pointers.push_back(nullptr);
    return pointers;
}

// The settings of this process for GoogleTest are not those of the programs: they would leave out tests, or what tests print.
std::vector<std::string> environmentWith(const std::vector<std::string>& settings) {
    std::vector<std::string> all;
    for (char** inherited = environ; *inherited != nullptr; ++inherited)
        if (!std::string_view(*inherited).starts_with("GTEST_")) all.emplace_back(*inherited);
    for (const std::string& setting : settings) {
        const std::string name = setting.substr(0, setting.find('=') + 1);
        std::erase_if(all, [&](const std::string& known) { return known.starts_with(name); });
        all.push_back(setting);
    }
    return all;
}

void restoreSignals() {
    for (const int signal : {SIGPIPE, SIGINT, SIGTERM, SIGHUP})
        std::signal(signal, SIG_DFL);
    sigset_t none;
    sigemptyset(&none);
    sigprocmask(SIG_SETMASK, &none, nullptr);
}

// Runs in the new process, with calls alone that are safe between fork and exec. Writes errno to `failure` if it fails.
[[noreturn]] void becomeProgram(char* const* words, char* const* environment, ChildStreams streams, pid_t parent, int failure) {
    setpgid(0, 0);
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) _exit(127); // it ended before prctl
    restoreSignals();
    const int nothing = open("/dev/null", O_RDONLY | O_CLOEXEC);
    if (nothing >= 0 && dup2(nothing, STDIN_FILENO) >= 0 && dup2(streams.output, STDOUT_FILENO) >= 0 &&
        dup2(streams.errors, STDERR_FILENO) >= 0)
        execve(words[0], words, environment);
    const int error = errno;
    [[maybe_unused]] const ssize_t told = write(failure, &error, sizeof error);
    _exit(127);
}

// Returns 0 once the program runs, else the errno value of the new process.
int failureOf(pid_t pid, int reading) {
    int error = 0;
    ssize_t got = 0;
    while ((got = read(reading, &error, sizeof error)) < 0 && errno == EINTR) {
    }
    if (got != sizeof error) return 0;
    waitpid(pid, nullptr, 0);
    return error;
}

} // namespace

int spawnProgram(std::vector<std::string> words, const std::vector<std::string>& settings,
                 const posix_spawn_file_actions_t& files, const posix_spawnattr_t* attributes, pid_t& pid) {
    std::vector<std::string> environment = environmentWith(settings);
    return posix_spawn(&pid, words[0].c_str(), &files, attributes, pointersTo(words).data(), pointersTo(environment).data());
}

int spawnFollower(std::vector<std::string> words, const std::vector<std::string>& settings, ChildStreams streams, pid_t& pid) {
    std::vector<std::string> environment = environmentWith(settings);
    const std::vector<char*> arguments = pointersTo(words), variables = pointersTo(environment);
    int failure[2];
    if (pipe2(failure, O_CLOEXEC) != 0) return errno;
    const pid_t parent = getpid();
    pid = fork();
    if (pid == 0) becomeProgram(arguments.data(), variables.data(), streams, parent, failure[1]);
    const int failed_fork = pid < 0 ? errno : 0;
    close(failure[1]);
    if (pid > 0) setpgid(pid, pid); // here as well: the group exists before anyone ends it
    const int failed = failed_fork != 0 ? failed_fork : failureOf(pid, failure[0]);
    close(failure[0]);
    return failed;
}

} // namespace device_check
